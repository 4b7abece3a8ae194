#include <culm/model/one_director.hpp>
#include <culm/simulation/quantity.hpp>

#include "place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace culm::simulation {
namespace {

class PointDistance final : public Quantity {
 public:
  PointDistance(const Place& from, const Place& to) : from_(from), to_(to) {}

  std::vector<output::HistoryColumn> columns() const override { return {{"", "m"}}; }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    numbers.push_back((from_.position(state.next) - to_.position(state.next)).norm());
  }

 private:
  Place from_, to_;
};

// From a point to the surface of a beam: to its axis, straight between nodes, less the radius
// there. Negative within the beam.
class Clearance final : public Quantity {
 public:
  /// @param radii  of the beam at its first and last node, linear along the axis [m]
  Clearance(const Place& point, const model::Structure& beam, const std::array<double, 2>& radii,
            const model::Coordinates& reference)
      : point_(point) {
    for (const model::Cell& cell : beam.cells) {
      for (std::size_t a = 0; a + 1 < cell.nodes.size(); ++a) {
        segments_.push_back({cell.nodes[a], cell.nodes[a + 1]});
      }
    }
    double length = 0.0;
    std::vector<double> ends = {0.0};
    for (const Segment& one : segments_) {
      length += (axis(reference, one.second) - axis(reference, one.first)).norm();
      ends.push_back(length);
    }
    for (const double end : ends) radii_.push_back(radii[0] + (radii[1] - radii[0]) * end / length);
  }

  std::vector<output::HistoryColumn> columns() const override { return {{"", "m"}}; }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    const Vec3 point = point_.position(state.next);
    double nearest = std::numeric_limits<double>::max();  // to the axis
    double radius = 0.0;                                  // there
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const Vec3 begin = axis(state.next, segments_[i].first);
      const Vec3 along = axis(state.next, segments_[i].second) - begin;
      const double at = std::clamp((point - begin).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double distance = (point - begin - at * along).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      radius = radii_[i] + at * (radii_[i + 1] - radii_[i]);
    }
    numbers.push_back(nearest - radius);
  }

 private:
  using Segment = std::pair<int, int>;  // nodes
  static Vec3 axis(const model::Coordinates& q, int node) {
    return model::NodeTable::slots(q, node).col(0);
  }

  Place point_;
  std::vector<Segment> segments_;
  std::vector<double> radii_;  // at the ends of the segments
};

std::unique_ptr<Quantity> make_distance(const Options& options, model::BuildContext& context) {
  const std::optional<Place> from = read_place(options, true, false, context);
  if (!from) return nullptr;
  if (options.has("To")) {
    const std::optional<int> to = read_node(options, "To", context);
    if (!to) return nullptr;
    model::check_components("To Offset", std::span(&*to, 1), options, context);
    return std::make_unique<PointDistance>(
        *from, Place{.node = *to, .offset = model::vector(options, "To Offset")});
  }
  const model::Structure* beam = model::select_structure(options, context);
  if (beam == nullptr) return nullptr;
  if (beam->line_points.empty()) {
    context.issues.add(options.where("Structure"), "structure '" + beam->name + "' is no beam");
    return nullptr;
  }
  if (std::ranges::find(beam->nodes, from->node) != beam->nodes.end()) {
    context.issues.add(options.where("Structure"),
                       "structure '" + beam->name + "' has the watched node itself");
    return nullptr;
  }
  const std::vector<double>& radii = options.numbers("Radii");
  return std::make_unique<Clearance>(*from, *beam, std::array{radii[0], radii[1]},
                                     context.model.nodes().reference());
}

}  // namespace

void register_distance_quantity(QuantityRegistry& registry) {
  Schema schema("Distance",
                "Distance of a point to another one, or to the surface of a beam, such as that of "
                "a blade tip to the tower: to its axis, straight between nodes, less its radius.");
  schema.add(model::node_field("Node", "The node, such as 'blade/last'."))
      .add(offset_field())
      .add(text("To", "Another node.").optional())
      .add(offset_field("To Offset"))
      .add(text("Structure", "Or a beam, of which the nearest place counts.").optional())
      .add(numbers("Radii", "m", "Of the beam at its first and last node, linear along its axis.")
               .size(2)
               .non_negative()
               .optional({0.0, 0.0}))
      .check([](const Options& options, InputIssues& issues) {
        if (options.has("To") == options.has("Structure")) {
          issues.add(options.where(), "needs either 'To' or 'Structure'");
          return;
        }
        for (const auto& [name, needed] : {std::pair{"Radii", "Structure"}, {"To Offset", "To"}}) {
          if (!options.given(name) || options.has(needed)) continue;
          issues.add(options.where(name), fmt::format("belongs to '{}', which is missing", needed));
        }
      });
  registry.add("Distance", std::move(schema), make_distance);
}

}  // namespace culm::simulation
