#include "line_table.hpp"

#include <culm/math/arc_length.hpp>
#include <culm/math/interpolation.hpp>

#include <algorithm>
#include <numeric>
#include <span>

namespace culm::load {
namespace {

// A piece of the line, from `begin` to `end` [m].
struct Interval {
  double begin, end;
  double length() const { return end - begin; }
};

// An element of the line, from `begin` on.
struct Part {
  double begin;
  ArcLength along;
  std::span<const double> shares;  // of its points
};

// Adds what the table between positions i and i + 1 gives to the points of an element.
void add_segment(const LineTable& table, std::size_t i, const Part& element,
                 std::span<Vec6> intensities) {
  const Interval segment{table.positions[i], table.positions[i + 1]};
  const Interval piece{std::max(segment.begin, element.begin),
                       std::min(segment.end, element.begin + element.along.length())};
  if (piece.length() <= 0.0) return;
  const auto rule = gauss_legendre(static_cast<int>(intensities.size()));
  const double first = element.along.xi_at(piece.begin - element.begin);
  const double last = element.along.xi_at(piece.end - element.begin);
  for (const auto& [eta, weight] : rule) {
    const double xi = first + 0.5 * (1.0 + eta) * (last - first);
    const double s = element.begin + element.along.at(xi);
    const double t = (s - segment.begin) / segment.length();
    const Vec6 f = (1.0 - t) * table.values[i] + t * table.values[i + 1];
    const double share = 0.5 * weight * (last - first) * element.along.rate(xi);
    for (std::size_t k = 0; k < rule.size(); ++k) {
      intensities[k] += share / element.shares[k] * lagrange(rule, k, xi) * f;
    }
  }
}

// A set may list an element twice: its first point comes again then.
bool is_same_element(const model::Marker& first, const model::Marker& later) {
  return later.nodes == first.nodes && later.weights != first.weights;
}

}  // namespace

double length_of(const std::vector<model::LinePoint>& line) {
  return std::accumulate(line.begin(), line.end(), 0.0,
                         [](double sum, const auto& point) { return sum + point.length; });
}

std::vector<Vec6> intensities(const LineTable& table, const std::vector<model::LinePoint>& line) {
  std::vector<Vec6> result(line.size(), Vec6::Zero());
  double begin = 0.0;
  for (std::size_t first = 0; first < line.size();) {
    std::size_t last = first;
    std::vector<double> shares;
    do {
      shares.push_back(line[last++].length);
    } while (last < line.size() && is_same_element(line[first].marker, line[last].marker));
    const Part element{begin, ArcLength(shares), shares};
    for (std::size_t i = 0; i + 1 < table.positions.size(); ++i) {
      add_segment(table, i, element, std::span(result).subspan(first, last - first));
    }
    first = last;
    begin += element.along.length();
  }
  return result;
}

}  // namespace culm::load
