#include <culm/joint/rigid_support.hpp>
#include <culm/joint/turn.hpp>
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

// Adds (R - 1)(x0 - a) to the translation that the first three rows prescribe.
void add_circling(const Vec3& arm, const Mat3& turn, std::vector<model::ConstraintRow>& rows) {
  const Vec3 way = turn * arm - arm;
  for (std::size_t i = 0; i < 3; ++i) rows[i].constant += way[static_cast<int>(i)];
}

// From the axis to the point; zero where the axis goes through it.
Vec3 arm_of(const Anchor& anchor, const SupportMotion& motion) {
  return motion.about ? Vec3(anchor.position() - *motion.about) : Vec3::Zero();
}

void hold_point(const Anchor& anchor, const SupportMotion& motion, model::Constraint& support) {
  add_vector_rows(anchor.point(), anchor, support);
  for (int i = 0; i < 3; ++i) {
    support.rows.push_back(model::linear_row(Vec3::Unit(i), anchor.vector(Vec3::Unit((i + 1) % 3)),
                                             anchor.reference()));
  }
  if (!motion.moves()) return;
  drive_constants(motion.translation, support);
  support.drive = [motion, arm = arm_of(anchor, motion), translate = std::move(support.drive)](
                      double time, std::vector<model::ConstraintRow>& rows) {
    translate(time, rows);
    const Mat3 turn = exp_rotation(motion.angle.at(time) * motion.axis);
    add_circling(arm, turn, rows);
    for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(3 + i)].direction = turn.col(i);
  };
}

// x - x0 - u(t) and d - R(t) d0 of a shell node
void move_shell_node(const Anchor& anchor, const SupportMotion& motion,
                     model::Constraint& support) {
  add_vector_rows(anchor.point(), anchor, support);
  add_vector_rows(anchor.director(), anchor, support);
  drive_constants(motion.translation, support);
  support.drive = [motion, d = Vec3(anchor.directors().col(0)), arm = arm_of(anchor, motion),
                   translate = std::move(support.drive)](double time,
                                                         std::vector<model::ConstraintRow>& rows) {
    translate(time, rows);
    const Mat3 turn = exp_rotation(motion.angle.at(time) * motion.axis);
    add_circling(arm, turn, rows);
    const Vec3 turned = turn * d;
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
  if (motion.angle.moves()) support.turn = turn_of_all(anchor, motion.axis, motion.angle);
  return support;
}

void register_rigid_support(model::BuilderRegistry& registry) {
  const std::string type = "Rigid Support";
  Schema schema(type, "Holds position and directors, or moves them as prescribed.");
  schema.add(anchor_field());
  add_translation(schema);
  schema
      .add(model::vector_field("Axis", "1", "Axis of a rotation, of any length.")
               .optional({0.0, 0.0, 1.0}))
      .add(model::vector_field("About", "m", "A point on this axis; the held point if absent.")
               .optional())
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
    SupportMotion motion{
        *std::move(translation), read_direction(options, "Axis"), *std::move(angle), {}};
    if (options.has("About")) motion.about = model::vector(options, "About");
    add_per_anchor(type, options, context, Holds::all,
                   [&](const Anchor& anchor) { return rigid_support(anchor, motion); });
  });
}

}  // namespace culm::joint
