#include <culm/base/nearest.hpp>
#include <culm/load/link_load.hpp>
#include <culm/simulation/quantity.hpp>

#include "place.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

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
    names.push_back(link->effect().name);
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

// The angle between two nodes about an axis of the first one, with all full turns or without.
class JointAngle final : public Quantity {
 public:
  JointAngle(const joint::MarkerPair& pair, const Vec3& axis, bool turns)
      : first_(pair.nodes().front()), second_(pair.nodes().back()), turns_(turns) {
    const Vec3 across = pair.across(axis);
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
    change_ = std::remainder(std::atan2(y[1], y[0]) - angle_, full);
    angle_ += change_;
    numbers.push_back(turns_ ? angle_ : angle_ - full * std::floor(angle_ / full));
  }
  // Within half a turn the way is told by the places; as much as a quarter may have been more than
  // half.
  std::string doubt() const override {
    if (!turns_ || std::abs(change_) <= 0.5 * std::numbers::pi) return {};
    return "changes by more than a quarter of a turn from one step to the next: beyond half a turn "
           "whole turns are lost; take smaller steps";
  }
  std::vector<double> memory() const override { return {angle_}; }
  void restore(std::span<const double> memory) override { angle_ = memory.front(); }
  bool relies_on_memory() const override { return turns_; }

 private:
  static Mat3 directors(const Eigen::Matrix3Xd& q, int first) { return q.middleCols<3>(first + 1); }

  int first_, second_;
  bool turns_;
  Eigen::Matrix<double, 3, 2> first_axes_;
  Vec3 second_axis_;
  mutable double angle_ = 0.0;   // of the state before
  mutable double change_ = 0.0;  // to the last one
};

std::optional<std::array<int, 2>> select_turning_nodes(const Options& options,
                                                       model::BuildContext& context) {
  const auto nodes = joint::select_two_nodes(options, context);
  if (!nodes || !has_triad((*nodes)[0], "First", options, context) ||
      !has_triad((*nodes)[1], "Second", options, context)) {
    return {};
  }
  return nodes;
}

std::unique_ptr<Quantity> make_angle(const Options& options, model::BuildContext& context) {
  const auto nodes = select_turning_nodes(options, context);
  if (!nodes) return nullptr;
  const joint::MarkerPair pair(context.model.nodes(), (*nodes)[0], (*nodes)[1], Vec3::Zero());
  return std::make_unique<JointAngle>(pair, model::vector(options, "Axis").normalized(),
                                      options.flag("Turns"));
}

// The rate of that angle: the speed of a rotor.
class JointSpeed final : public Quantity {
 public:
  /// @param axis  in the directors of the first node
  JointSpeed(const std::array<int, 2>& nodes, const Vec3& axis) : nodes_(nodes), axis_(axis) {}

  std::vector<HistoryColumn> columns() const override { return {{"", "rad/s"}}; }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    const Place second{nodes_[1], Vec3::Zero(), nodes_[0]};
    numbers.push_back(axis_.dot(second.seen_spin(state)));
  }

 private:
  std::array<int, 2> nodes_;
  Vec3 axis_;
};

std::unique_ptr<Quantity> make_speed(const Options& options, model::BuildContext& context) {
  const auto nodes = select_turning_nodes(options, context);
  if (!nodes) return nullptr;
  const auto& reference = context.model.nodes().reference();
  const Mat3 directors = model::NodeTable::slots(reference, (*nodes)[0]).rightCols<3>();
  const Vec3 axis = model::vector(options, "Axis").normalized();
  return std::make_unique<JointSpeed>(*nodes, directors.transpose() * axis);
}

Schema joint_schema(const std::string& type, const std::string& doc) {
  Schema schema(type, doc);
  schema.add(model::node_field("First", "Node that the angle is measured from."))
      .add(model::node_field("Second", "The other node of the joint."));
  joint::add_direction("Axis", "Axis of the joint in the reference, of any length.", schema);
  return schema;
}

}  // namespace

void register_link_quantities(QuantityRegistry& registry) {
  registry.add("Link",
               Schema("Link",
                      "Elongation and force, or angle and moment, of a spring, damper or drive; "
                      "the force is that of the step, positive where it resists elongation.")
                   .add(text("Load", "Its name in the list Loads.")),
               make_link);
  Schema angle = joint_schema(
      "Joint Angle",
      "Angle by which the second node has turned about an axis against the first; steps must be "
      "less than half a turn.");
  angle.add(flag("Turns",
                 "Whether full turns count; without them the angle is an azimuth, from 0 "
                 "to 2 pi.")
                .optional(true));
  registry.add("Joint Angle", angle, make_angle);
  registry.add("Joint Speed",
               joint_schema("Joint Speed",
                            "Angular velocity of the second node against the first about an axis "
                            "fixed in the first, such as the speed of a rotor; zero in statics."),
               make_speed);
}

}  // namespace culm::simulation
