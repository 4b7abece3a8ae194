#include <culm/joint/joint_angle.hpp>
#include <culm/joint/turn.hpp>

#include "supports.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace culm::joint {

model::Constraint joint_angle(const MarkerPair& pair, const Vec3& axis, const Prescribed& motion) {
  const Vec3 n1 = pair.across(axis);
  const Vec3 n2 = axis.cross(n1);
  model::Constraint joint = pair.joint();
  pair.add_angle_row(n2, n1, joint);
  if (const model::Signal* signal = motion.function.signal(); signal != nullptr && motion.moves()) {
    const double amount = motion.amount;
    joint.follow = model::Constraint::Follow{
        *signal,
        [=](double value, std::vector<model::ConstraintRow>& rows) {
          const double alpha = amount * value;
          rows.front().alpha = pair.vector(0, -std::sin(alpha) * n1 + std::cos(alpha) * n2);
        },
        [=](double value, std::vector<model::ConstraintRow>& rows) {
          const double alpha = amount * value;
          rows.front().alpha =
              pair.vector(0, -amount * (std::cos(alpha) * n1 + std::sin(alpha) * n2));
        }};
  } else if (motion.moves()) {
    joint.drive = [=](double time, std::vector<model::ConstraintRow>& rows) {
      const double alpha = motion.at(time);
      rows.front().alpha = pair.vector(0, -std::sin(alpha) * n1 + std::cos(alpha) * n2);
    };
  }
  if (motion.moves()) joint.turn = turn_between(pair, axis, motion);
  return joint;
}

void register_joint_angle(model::BuilderRegistry& registry) {
  const std::string type = "Joint Angle";
  Schema schema = pair_schema(
      type, "Prescribes the angle of a revolute joint, by which the second node turns.");
  add_direction("Axis", "Axis of the joint in the reference, of any length.", schema);
  add_motion("Angle", "rad", "Angle at function value 1.", schema);
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    const auto motion = read_motion(options, "Angle", context, "Function", model::Follows::signals);
    if (!motion) return;
    const model::Signal* signal = motion->function.signal();
    if (signal != nullptr && signal->kind != model::UnknownKind::first_order) {
      context.issues.add(options.where("Function"),
                         "signal '" + options.text("Function") +
                             "' has one value per step and cannot prescribe an angle; put a 'Lag' "
                             "or an 'Actuator' behind it");
      return;
    }
    add_joint(type, options, context, [&](const MarkerPair& pair) {
      return joint_angle(pair, model::vector(options, "Axis").normalized(), *motion);
    });
  });
}

}  // namespace culm::joint
