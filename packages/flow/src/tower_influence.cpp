#include "tower_influence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace culm::flow {
namespace {

using std::numbers::pi;

// Close to the tower, or behind one of much drag, the formulas of wakes leave their range. As in
// AeroDyn they take half of the wind at most.
constexpr double largest_deficit = 0.5;

// A tower in its reference, a straight line with a radius that is linear along it.
struct Tower {
  Vec3 foot = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();
  double length = 0.0;
  double radius_at_foot = 0.0, radius_at_top = 0.0;

  double radius(double height) const {
    return radius_at_foot + height / length * (radius_at_top - radius_at_foot);
  }
};

class WindAroundTower final : public Flow {
 public:
  WindAroundTower(SharedFlow wind, std::string name, const Tower& tower,
                  const TowerInfluence& influence)
      : Flow(wind->density()),
        wind_(std::move(wind)),
        name_(std::move(name)),
        tower_(tower),
        influence_(influence) {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    wind_->velocities(places, time, velocities);
    for (std::size_t i = 0; i < places.size(); ++i) velocities[i] += change(places[i], time);
  }
  Mat3 gradient(const Vec3& place, double time) const override {
    Mat3 result = wind_->gradient(place, time);
    const double h = 1e-5 * tower_.radius_at_foot;
    for (int k = 0; k < 3; ++k) {
      const Vec3 way = h * Vec3::Unit(k);
      result.col(k) += (change(place + way, time) - change(place - way, time)) / (2.0 * h);
    }
    return result;
  }
  bool is_above_ground(const Vec3& place) const override { return wind_->is_above_ground(place); }
  std::string stands_about() const override { return name_; }
  SharedFlow without_structure() const override { return wind_; }

 private:
  Vec3 change(const Vec3& place, double time) const {
    const double height = tower_.axis.dot(place - tower_.foot);
    const double inside = std::clamp(height, 0.0, tower_.length);
    const double radius = tower_.radius(inside);
    // beyond its ends the tower is felt as far as it is thick
    const double share = 1.0 - std::abs(height - inside) / (2.0 * radius);
    if (share <= 0.0) return Vec3::Zero();
    const Vec3 centre = tower_.foot + inside * tower_.axis;
    Vec3 wind = wind_->velocity(centre, time);
    wind -= tower_.axis * tower_.axis.dot(wind);
    const double speed = wind.norm();
    if (speed == 0.0) return Vec3::Zero();
    const Vec3 along = wind / speed;
    const Vec3 across = tower_.axis.cross(along);
    const Vec3 from_axis = place - centre;
    const Eigen::Vector2d change =
        influence_.change(along.dot(from_axis) / radius, across.dot(from_axis) / radius);
    return share * speed * (change[0] * along + change[1] * across);
  }

  SharedFlow wind_;
  std::string name_;
  Tower tower_;
  TowerInfluence influence_;
};

Schema tower_schema() {
  Schema schema("Tower Influence",
                "Flow about a tower, from the wind at its axis in the reference, and its wake.");
  schema.add(model::structure_field())
      .add(numbers("Diameters", "m", "At the first and at the last node, linear between them.")
               .size(2)
               .positive())
      .add(choice("Upstream", {"Potential", "Bak", "None"},
                  "Flow about a cylinder without friction, with the correction of Bak, or none.")
               .optional("Potential"))
      .add(choice("Downstream", {"Powles", "Eames", "None"}, "Wake behind the tower.")
               .optional("Powles"))
      .add(number("Drag", "1", "Coefficient of drag of the tower.").non_negative().optional(1.0))
      .add(number("Turbulence", "1", "Intensity of turbulence, of the wake of Eames.")
               .positive()
               .optional(0.1));
  return schema;
}

TowerInfluence read_influence(const Options& options) {
  using Upstream = TowerInfluence::Upstream;
  using Downstream = TowerInfluence::Downstream;
  TowerInfluence influence;
  const std::string& upstream = options.text("Upstream");
  const std::string& downstream = options.text("Downstream");
  influence.upstream = upstream == "Bak"    ? Upstream::bak
                       : upstream == "None" ? Upstream::none
                                            : Upstream::potential;
  influence.downstream = downstream == "Eames"  ? Downstream::eames
                         : downstream == "None" ? Downstream::none
                                                : Downstream::powles;
  influence.drag = options.number("Drag");
  influence.turbulence = options.number("Turbulence");
  return influence;
}

// Null, and an issue, if there is no such structure or it is no line.
SharedFlow put_around(const Options& options, model::BuildContext& context, SharedFlow wind) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return nullptr;
  if (structure->line_points.empty()) {
    context.issues.add(options.where("Structure"),
                       "structure '" + structure->name + "' is no beam");
    return nullptr;
  }
  const model::Coordinates& q = context.model.nodes().reference();
  Tower tower;
  tower.foot = model::NodeTable::slots(q, structure->nodes.front()).col(0);
  const Vec3 way = Vec3(model::NodeTable::slots(q, structure->nodes.back()).col(0)) - tower.foot;
  tower.length = way.norm();
  tower.axis = way / tower.length;
  const std::vector<double>& diameters = options.numbers("Diameters");
  tower.radius_at_foot = 0.5 * diameters[0];
  tower.radius_at_top = 0.5 * diameters[1];
  return std::make_shared<WindAroundTower>(std::move(wind), structure->name, tower,
                                           read_influence(options));
}

}  // namespace

Eigen::Vector2d TowerInfluence::change(double along, double across) const {
  const double distance = std::hypot(along, across);
  if (distance < 1.0) {
    const double factor = distance > 0.0 ? 1.0 / distance : 0.0;
    along = distance > 0.0 ? factor * along : -1.0;
    across *= factor;
  }
  Eigen::Vector2d change = Eigen::Vector2d::Zero();
  if (upstream != Upstream::none) {
    const double x = upstream == Upstream::bak ? along + 0.1 : along;
    const double square = x * x + across * across;
    change += Eigen::Vector2d(across * across - x * x, -2.0 * x * across) / (square * square);
    if (upstream == Upstream::bak) {
      change += drag / (2.0 * pi * square) * Eigen::Vector2d(x, across);
    }
  }
  if (downstream == Downstream::none || along <= 0.0) return change;
  double deficit = 0.0;
  if (downstream == Downstream::powles) {
    const double root = std::sqrt(std::hypot(along, across));
    if (std::abs(across) < root) {
      const double shape = std::cos(0.5 * pi * across / root);
      deficit = drag / root * shape * shape;
    }
  } else {
    const double width = turbulence * along;
    const double share = across / width;
    deficit = drag / (width * std::sqrt(2.0 * pi)) * std::exp(-0.5 * share * share);
  }
  change[0] -= std::min(deficit, largest_deficit);
  return change;
}

void add_wind(FlowRegistry& registry, const std::string& name, Schema schema,
              std::function<SharedFlow(const Options&, model::BuildContext&)> make) {
  schema.list("Tower Influence", tower_schema(), Presence::optional);
  registry.add(
      name, std::move(schema),
      [make = std::move(make)](const Options& options, model::BuildContext& context) -> SharedFlow {
        SharedFlow wind = make(options, context);
        if (wind == nullptr || !options.has_list("Tower Influence")) return wind;
        return put_around(options.list("Tower Influence"), context, std::move(wind));
      });
}

}  // namespace culm::flow
