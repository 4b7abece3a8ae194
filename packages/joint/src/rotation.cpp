#include <culm/joint/rotation.hpp>
#include <culm/joint/turn.hpp>

#include "supports.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace culm::joint {
namespace {

model::ConstraintRow row_of(const Vec3& direction, model::SlotSum attached) {
  model::ConstraintRow row;
  row.direction = direction;
  row.alpha = std::move(attached);
  return row;
}

void register_rotation_type(model::BuilderRegistry& registry, const std::string& type,
                            const std::string& doc, decltype(&rotation) make) {
  Schema schema = directed_schema(type, doc, "Axis", "Axis in the reference, of any length.");
  add_motion("Angle", "rad", "Angle of rotation at function value 1.", schema);
  registry.add(type, schema, [type, make](const Options& options, model::BuildContext& context) {
    const auto motion = read_motion(options, "Angle", context);
    if (!motion) return;
    add_per_anchor(type, options, context, Holds::triads, [&](const Anchor& anchor) {
      return make(anchor, read_direction(options, "Axis"), *motion);
    });
  });
}

}  // namespace

model::Constraint rotation(const Anchor& anchor, const Vec3& axis, const Prescribed& motion) {
  const Vec3 c0 = anchor.across(axis);
  const Vec3 across = axis.cross(c0);
  model::Constraint support = support_of(anchor);
  support.rows = {row_of(across, anchor.vector(c0))};
  if (motion.moves()) {
    support.drive = [=](double time, std::vector<model::ConstraintRow>& rows) {
      const double alpha = motion.at(time);
      rows.front().direction = -std::sin(alpha) * c0 + std::cos(alpha) * across;
    };
    support.turn = turn_about(anchor, axis, motion);
  }
  return support;
}

model::Constraint rotation_local(const Anchor& anchor, const Vec3& axis, const Prescribed& motion) {
  const Vec3 c0 = anchor.across(axis);
  const Vec3 across = axis.cross(c0);
  model::Constraint support = support_of(anchor);
  support.rows = {row_of(c0, anchor.vector(across))};
  if (motion.moves()) {
    support.drive = [=](double time, std::vector<model::ConstraintRow>& rows) {
      const double alpha = motion.at(time);
      rows.front().alpha = anchor.vector(std::sin(alpha) * c0 + std::cos(alpha) * across);
    };
    support.turn = turn_about(anchor, axis, motion);
  }
  return support;
}

void register_rotation(model::BuilderRegistry& registry) {
  register_rotation_type(
      registry, "Rotation",
      "Prescribes the rotation about an axis fixed in space; the others stay free.", &rotation);
  register_rotation_type(
      registry, "Rotation Local",
      "Prescribes the rotation about an axis fixed in the node; the others stay free.",
      &rotation_local);
}

}  // namespace culm::joint
