#include <culm/base/error.hpp>
#include <culm/math/arc_length.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/model/structure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace culm::model {

void LinePoints::push_back(const LinePoint& point) {
  const Marker& marker = point.marker;
  const CellNodes nodes(marker.nodes.begin(), marker.nodes.end());
  const bool is_first = empty();
  const bool is_on_last = !is_first && std::ranges::equal(nodes, last_nodes_);
  if (!is_first && per_element_ == 0 && !is_on_last) per_element_ = size();
  const bool is_full = per_element_ != 0 && size() % per_element_ == 0;
  internal_check(marker.offset.isZero(0.0) && (is_first || nodes.size() == last_nodes_.size()) &&
                     (is_first || is_full || is_on_last),
                 "elements of a line are of one kind, and points on its axis");
  if (is_first || is_full) {
    last_nodes_ = nodes;
    elements_.push_back({nodes});
  }
  const auto weights = std::ranges::find(weights_, marker.weights) - weights_.begin();
  internal_check(weights <= std::numeric_limits<std::uint8_t>::max(),
                 "points of a line are few kinds");
  if (weights == std::ssize(weights_)) weights_.push_back(marker.weights);
  weights_of_.push_back(static_cast<std::uint8_t>(weights));
  lengths_.push_back(point.length);
}

void LinePoints::reserve(std::size_t points) {
  weights_of_.reserve(points);
  lengths_.reserve(points);
}

LinePoint LinePoints::operator[](std::size_t i) const {
  const Cell element = elements_[per_element_ == 0 ? 0 : i / per_element_];
  return {{{element.nodes.begin(), element.nodes.end()}, weights_[weights_of_[i]], Vec3::Zero()},
          lengths_[i]};
}

double LinePoints::length() const { return std::accumulate(lengths_.begin(), lengths_.end(), 0.0); }

std::vector<LinePoint> LinePoints::copy(std::size_t first, std::size_t count) const {
  std::vector<LinePoint> points;
  points.reserve(count);
  for (std::size_t i = first; i < first + count; ++i) points.push_back((*this)[i]);
  return points;
}

std::vector<int> Structure::cells_of(int number) const {
  if (deck.cells.empty()) return {number};
  return deck.cells[static_cast<std::size_t>(number)];
}
namespace {

template <int Order>
std::vector<double> shape_values(double xi) {
  const auto N = Lagrange<Order>::values(xi);
  return {N.begin(), N.end()};
}

std::vector<double> shape_values(std::size_t nodes, double xi) {
  if (nodes == 2) return shape_values<1>(xi);
  return nodes == 3 ? shape_values<2>(xi) : shape_values<3>(xi);
}

}  // namespace

std::optional<Marker> marker_at_fraction(const Structure& structure, double fraction) {
  if (structure.line_points.empty()) return {};
  // all elements of a structure are of one kind, hence have as many points
  const std::size_t per_element = structure.line_points.size() / structure.cells.size();
  std::vector<double> end(structure.cells.size(), 0.0);  // length up to the end of each element
  double length = 0.0;
  for (std::size_t k = 0; k < structure.line_points.size(); ++k) {
    length += structure.line_points.length(k);
    end[k / per_element] = length;
  }
  const double wanted = fraction * length;
  const auto last = end.end() - 1;
  const auto cell =
      static_cast<std::size_t>(std::lower_bound(end.begin(), last, wanted) - end.begin());
  const double begin = cell == 0 ? 0.0 : end[cell - 1];
  std::vector<double> shares(per_element);
  for (std::size_t k = 0; k < per_element; ++k) {
    shares[k] = structure.line_points.length(cell * per_element + k);
  }
  const double xi = ArcLength(shares).xi_at(wanted - begin);
  const CellNodes& nodes = structure.cells[cell].nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double at = -1.0 + 2.0 * static_cast<double>(a) / static_cast<double>(nodes.size() - 1);
    if (std::abs(xi - at) < 1e-9) return marker_at(nodes[a]);
  }
  return Marker{{nodes.begin(), nodes.end()}, shape_values(nodes.size(), xi), Vec3::Zero()};
}

}  // namespace culm::model
