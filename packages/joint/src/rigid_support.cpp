#include <culm/joint/rigid_support.hpp>
#include <culm/math/rotation.hpp>

#include "supports.hpp"

#include <utility>

namespace culm::joint {
namespace {

// x - x0 and d_i - d_i0
void hold_node(const Anchor& anchor, model::Constraint& support) {
  const std::size_t slots = anchor.on_shell() ? 2 : 4;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    model::SlotSum alpha(4, 0.0);
    alpha[slot] = 1.0;
    add_vector_rows(alpha, anchor, support);
  }
  support.fix = {anchor.node(), {0b111111}};
  support.replaces_internal = anchor.node();
}

void hold_point(const Anchor& anchor, const SupportMotion& motion, model::Constraint& support) {
  add_vector_rows(anchor.point(), anchor, support);
  for (int i = 0; i < 3; ++i) {
    support.rows.push_back(model::linear_row(Vec3::Unit(i), anchor.vector(Vec3::Unit((i + 1) % 3)),
                                             anchor.reference()));
  }
  if (!motion.moves()) return;
  drive_constants(motion.translation, support);
  support.drive = [motion, translate = std::move(support.drive)](
                      double time, std::vector<model::ConstraintRow>& rows) {
    translate(time, rows);
    const Mat3 turn = exp_rotation(motion.angle.at(time) * motion.axis);
    for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(3 + i)].direction = turn.col(i);
  };
}

// x - x0 - u(t) and d - R(t) d0 of a shell node
void move_shell_node(const Anchor& anchor, const SupportMotion& motion,
                     model::Constraint& support) {
  add_vector_rows(anchor.point(), anchor, support);
  add_vector_rows(anchor.director(), anchor, support);
  drive_constants(motion.translation, support);
  support.drive = [motion, d = Vec3(anchor.directors().col(0)),
                   translate = std::move(support.drive)](double time,
                                                         std::vector<model::ConstraintRow>& rows) {
    translate(time, rows);
    const Vec3 turned = exp_rotation(motion.angle.at(time) * motion.axis) * d;
    for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(3 + i)].constant = turned[i];
  };
}

}  // namespace

model::Constraint rigid_support(const Anchor& anchor, const SupportMotion& motion) {
  model::Constraint support = support_of(anchor);
  if (motion.moves() && anchor.on_shell()) {
    move_shell_node(anchor, motion, support);
  } else if (motion.moves() || anchor.node() < 0) {
    hold_point(anchor, motion, support);
  } else {
    hold_node(anchor, support);
  }
  return support;
}

void register_rigid_support(model::BuilderRegistry& registry) {
  const std::string type = "Rigid Support";
  Schema schema(type, "Holds position and directors, or moves them as prescribed.");
  schema.add(anchor_field());
  add_translation(schema);
  schema
      .add(model::vector_field("Axis", "1", "Axis of a rotation about the point, of any length.")
               .optional({0.0, 0.0, 1.0}))
      .add(number("Angle", "rad", "Angle of rotation at function value 1.").optional(0.0))
      .add(model::function_field("Ramp", "Angle Function"))
      .check([](const Options& options, InputIssues& issues) {
        if (model::vector(options, "Axis").isZero(0.0)) {
          issues.add(options.where("Axis"), "must not be zero");
        }
      });
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    auto translation = read_translation(options, context);
    auto angle = read_motion(options, "Angle", context, "Angle Function");
    if (!translation || !angle) return;
    const SupportMotion motion{*std::move(translation), read_direction(options, "Axis"),
                               *std::move(angle)};
    add_per_anchor(type, options, context, Holds::all,
                   [&](const Anchor& anchor) { return rigid_support(anchor, motion); });
  });
}

}  // namespace culm::joint
