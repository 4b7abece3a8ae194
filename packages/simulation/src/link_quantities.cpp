#include <culm/base/nearest.hpp>
#include <culm/load/link_load.hpp>
#include <culm/math/rotation.hpp>
#include <culm/simulation/quantity.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace culm::simulation {
namespace {

using output::HistoryColumn;

class LinkQuantity final : public Quantity {
 public:
  explicit LinkQuantity(const load::LinkLoad& link) : link_(link) {}

  std::vector<HistoryColumn> columns() const override {
    if (link_.link(0).measure == load::Measure::angle) return {{"angle", "rad"}, {"M", "N m"}};
    return {{"elongation", "m"}, {"F", "N"}};
  }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const load::LinkLoad::Sample sample = link_.sample(0, state);
    // one rank has it, so the sum is exact
    std::array<double, 2> values = {sample.coordinate, sample.force};
    system.comm().sum(values);
    numbers.insert(numbers.end(), values.begin(), values.end());
  }

 private:
  const load::LinkLoad& link_;
};

std::unique_ptr<Quantity> make_link(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Load");
  std::vector<std::string> names;
  for (const auto& batch : context.model.loads()) {
    const auto* link = dynamic_cast<const load::LinkLoad*>(batch.get());
    if (link == nullptr) continue;
    // effects are named "type, name"
    names.push_back(link->effect().substr(link->effect().find(", ") + 2));
    if (names.back() != name) continue;
    if (link->size() == 1) return std::make_unique<LinkQuantity>(*link);
    context.issues.add(options.where("Load"),
                       "'" + name + "' acts on " + std::to_string(link->size()) +
                           " nodes, but one spring, damper or drive is watched");
    return nullptr;
  }
  context.issues.add(options.where("Load"),
                     "no spring, damper or drive '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

// The angle between two nodes about an axis of the first one, with all full turns.
class JointAngle final : public Quantity {
 public:
  JointAngle(const joint::MarkerPair& pair, const Vec3& axis)
      : first_(pair.nodes().front()), second_(pair.nodes().back()) {
    const Vec3 across = any_normal(axis);
    first_axes_ << across, axis.cross(across);
    first_axes_ = directors(pair.reference(), 0).transpose() * first_axes_;
    second_axis_ = directors(pair.reference(), 4).transpose() * across;
  }

  std::vector<HistoryColumn> columns() const override { return {{"", "rad"}}; }
  // states come in the order of time
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    const Mat3 d1 = model::NodeTable::slots(state.next, first_).rightCols<3>();
    const Mat3 d2 = model::NodeTable::slots(state.next, second_).rightCols<3>();
    const Eigen::Vector2d y = (d1 * first_axes_).transpose() * (d2 * second_axis_);
    const double full = 2.0 * std::numbers::pi;
    angle_ += std::remainder(std::atan2(y[1], y[0]) - angle_, full);
    numbers.push_back(angle_);
  }
  double memory() const override { return angle_; }
  void restore(double memory) override { angle_ = memory; }

 private:
  static Mat3 directors(const Eigen::Matrix3Xd& q, int first) { return q.middleCols<3>(first + 1); }

  int first_, second_;
  Eigen::Matrix<double, 3, 2> first_axes_;
  Vec3 second_axis_;
  mutable double angle_ = 0.0;  // of the state before
};

std::unique_ptr<Quantity> make_angle(const Options& options, model::BuildContext& context) {
  const auto nodes = joint::select_two_nodes(options, context);
  if (!nodes) return nullptr;
  const joint::MarkerPair pair(context.model.nodes(), (*nodes)[0], (*nodes)[1], Vec3::Zero());
  return std::make_unique<JointAngle>(pair, model::vector(options, "Axis").normalized());
}

}  // namespace

void register_link_quantities(QuantityRegistry& registry) {
  registry.add("Link",
               Schema("Link",
                      "Elongation and force, or angle and moment, of a spring, damper or drive; "
                      "the force is that of the step, positive where it resists elongation.")
                   .add(text("Load", "Its name in the list Loads.")),
               make_link);
  Schema angle("Joint Angle",
               "Angle by which the second node has turned about an axis against the first, with "
               "all full turns; steps must be less than half a turn.");
  angle.add(model::node_field("First", "Node that the angle is measured from."))
      .add(model::node_field("Second", "The other node of the joint."));
  joint::add_direction("Axis", "Axis of the joint in the reference, of any length.", angle);
  registry.add("Joint Angle", angle, make_angle);
}

}  // namespace culm::simulation
