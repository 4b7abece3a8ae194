#include <culm/strip/shared_chord.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace culm::strip {
namespace {

constexpr double same_direction = 0.7;  // least cosine between chords that lie over each other
constexpr double rounding = 1e-9;       // of a chord, and of the whole air

struct Interval {
  double from = 0.0, to = 0.0;
};

// Behind the axis, from nose to tail; turned round where the other chord is [m].
Interval extent(const Station& station, bool is_turned_round) {
  const double nose = -station.axis_at * station.chord;
  const double tail = nose + station.chord;
  return is_turned_round ? Interval{-tail, -nose} : Interval{nose, tail};
}

bool lie_over_each_other(const Station& a, const Station& b) {
  const double cosine = a.along.dot(b.along);
  if (std::abs(cosine) < same_direction) return false;
  const Interval one = extent(a, false), other = extent(b, cosine < 0.0);
  const double common = std::min(one.to, other.to) - std::max(one.from, other.from);
  return common > rounding * std::max(a.chord, b.chord);
}

// A load of a line has points between nodes, others are on nodes.
bool is_on_line(const StripLoad& load) {
  return std::ranges::any_of(load.stations(),
                             [](const Station& station) { return station.point.nodes.size() > 1; });
}

Vec3 place_of(const model::Marker& point, const model::Coordinates& q) {
  Vec3 x = Vec3::Zero();
  for (std::size_t i = 0; i < point.nodes.size(); ++i) {
    x += point.weights[i] * model::NodeTable::slots(q, point.nodes[i]).col(0);
  }
  return x;
}

bool share_on_lines(const std::vector<Station>& few, const std::vector<Station>& many) {
  for (std::size_t i = 0; i < many.size(); ++i) {
    if (lie_over_each_other(many[i], few[i * few.size() / many.size()])) return true;
  }
  return false;
}

bool share_on_nodes(const std::vector<Station>& a, const std::vector<Station>& b) {
  return std::ranges::any_of(a, [&](const Station& one) {
    return std::ranges::any_of(b, [&](const Station& other) {
      return one.point.nodes == other.point.nodes && lie_over_each_other(one, other);
    });
  });
}

bool share_with_nodes(const std::vector<Station>& line, const std::vector<Station>& nodes,
                      const model::Model& model) {
  const model::Coordinates& reference = model.nodes().reference();
  const model::Structure* structure = model.structure_of(line.front().point.nodes.front());
  return std::ranges::any_of(nodes, [&](const Station& node) {
    if (model.structure_of(node.point.nodes.front()) != structure) return false;
    const Vec3 x = place_of(node.point, reference);
    const auto nearest = std::ranges::min_element(line, {}, [&](const Station& station) {
      return (place_of(station.point, reference) - x).squaredNorm();
    });
    return lie_over_each_other(*nearest, node);
  });
}

}  // namespace

bool share_chord(const StripLoad& a, const StripLoad& b, const model::Model& model) {
  const std::vector<Station>& one = a.stations();
  const std::vector<Station>& other = b.stations();
  if (one.empty() || other.empty()) return false;
  if (is_on_line(a) != is_on_line(b)) {
    return is_on_line(a) ? share_with_nodes(one, other, model)
                         : share_with_nodes(other, one, model);
  }
  if (!is_on_line(a)) return share_on_nodes(one, other);
  const auto structure = [&](const std::vector<Station>& stations) {
    return model.structure_of(stations.front().point.nodes.front());
  };
  if (structure(one) != structure(other)) return false;
  return one.size() < other.size() ? share_on_lines(one, other) : share_on_lines(other, one);
}

bool count_twice(const StripLoad& a, const StripLoad& b, const model::State& state,
                 const Stencil& stencil) {
  const double one = std::abs(a.amplitude().in_step(state, stencil));
  const double other = std::abs(b.amplitude().in_step(state, stencil));
  return one + other > std::max({1.0, one, other}) + rounding;
}

}  // namespace culm::strip
