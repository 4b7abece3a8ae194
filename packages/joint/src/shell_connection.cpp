#include <culm/joint/shell_connection.hpp>
#include <culm/math/rotation.hpp>

#include "supports.hpp"

#include <Eigen/Geometry>

#include <utility>

namespace culm::joint {
namespace {

using model::attached_vector;
using model::Constraint;
using model::NodeTable;
using model::SlotSum;

Constraint between(int first, int second) {
  Constraint joint;
  joint.nodes = {first, second};
  joint.is_internal = true;
  return joint;
}

Eigen::Matrix3Xd reference(const NodeTable& nodes, const Constraint& joint) {
  return model::slots_of(joint, nodes.reference());
}

// a slot of the first node plus `factor` times that of the second stays as it is
void add_slot_rows(int slot, double factor, const Eigen::Matrix3Xd& q, Constraint& joint) {
  SlotSum alpha(8, 0.0);
  alpha[static_cast<std::size_t>(slot)] = 1.0;
  alpha[static_cast<std::size_t>(4 + slot)] = factor;
  for (int i = 0; i < 3; ++i) {
    joint.rows.push_back(model::linear_row(Vec3::Unit(i), alpha, q));
  }
}

// half of d . d, so that the gradient is d itself
void add_length_row(int node, int num_nodes, const Eigen::Matrix3Xd& q, Constraint& joint) {
  joint.rows.push_back(model::product_row(attached_vector(node, num_nodes, 0.5 * Vec3::UnitX()),
                                          attached_vector(node, num_nodes, Vec3::UnitX()), q));
}

// (d_A - b d_B) . (d_B - b d_A) = 0 of unit directors at the angle phi, b = tan(pi/4 - phi/2), over
// what makes it the change of the angle. By a director its gradient is normal to this director, so
// that it carries a moment and does not pull at the thickness; d_A . d_B alone would, with
// moment * cot phi, which makes a sharp edge soft.
void add_angle_row(const Eigen::Matrix3Xd& q, Constraint& joint) {
  const double size_a = q.col(1).norm();
  const double size_b = q.col(5).norm();
  const Vec3 a = q.col(1) / size_a;
  const Vec3 b = q.col(5) / size_b;
  const double sine = a.cross(b).norm();
  const double tangent = a.dot(b) / (1.0 + sine);
  const double scale = 0.5 * (1.0 + sine) / sine;
  SlotSum first(8, 0.0);
  SlotSum second(8, 0.0);
  first[1] = scale / size_a;
  first[5] = -scale * tangent / size_b;
  second[1] = -tangent / size_a;
  second[5] = 1.0 / size_b;
  joint.rows.push_back(model::product_row(std::move(first), std::move(second), q));
}

}  // namespace

Constraint hinge_connection(const NodeTable& nodes, int first, int second) {
  Constraint joint = between(first, second);
  add_slot_rows(0, -1.0, reference(nodes, joint), joint);
  return joint;
}

Constraint fold_connection(const NodeTable& nodes, int first, int second, bool inextensible) {
  Constraint joint = hinge_connection(nodes, first, second);
  const Eigen::Matrix3Xd q = reference(nodes, joint);
  const Vec3 d_first = q.col(1);
  const Vec3 d_second = q.col(5);
  const double sine = d_first.normalized().cross(d_second.normalized()).norm();
  const bool parallel = sine <= parallel_directors;
  if (parallel) {
    add_slot_rows(1, d_first.dot(d_second) > 0.0 ? -1.0 : 1.0, q, joint);
  } else {
    add_angle_row(q, joint);
  }
  if (inextensible) {
    add_length_row(0, 2, q, joint);
    if (!parallel) add_length_row(1, 2, q, joint);
  }
  return joint;
}

Constraint layer_connection(const NodeTable& nodes, int first, int second, double first_thickness,
                            double second_thickness) {
  Constraint joint = between(first, second);
  const Eigen::Matrix3Xd q = reference(nodes, joint);
  const SlotSum alpha = {1.0,  0.5 * first_thickness,  0.0, 0.0,
                         -1.0, 0.5 * second_thickness, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    joint.rows.push_back(model::linear_row(Vec3::Unit(i), alpha, q));
  }
  return joint;
}

Constraint inextensible_director(const NodeTable& nodes, int node) {
  Constraint constraint;
  constraint.nodes = {node};
  constraint.is_internal = true;
  add_length_row(0, 1, reference(nodes, constraint), constraint);
  return constraint;
}

Constraint director_support(const NodeTable& nodes, int node, const Vec3& direction) {
  Constraint support;
  support.nodes = {node};
  support.rows = {model::linear_row(direction, attached_vector(0, 1, Vec3::UnitX()),
                                    reference(nodes, support))};
  if (const auto axis = coordinate_axis(direction)) {
    support.fix = {node, std::bitset<6>().set(3 + *axis)};
  }
  return support;
}

Constraint soft_transition(const NodeTable& nodes, int shell_node, int master) {
  Constraint joint = between(master, shell_node);
  const Eigen::Matrix3Xd q = reference(nodes, joint);
  const Mat3 triad = q.block<3, 3>(0, 1);
  const Vec3 d = q.col(5).normalized();
  const Vec3 across = any_normal(d);
  SlotSum gap(8, 0.0);
  gap[0] = -1.0;
  gap[4] = 1.0;
  for (const Vec3& tau : {across, Vec3(d.cross(across))}) {
    const SlotSum attached = attached_vector(0, 2, triad.transpose() * tau);
    joint.rows.push_back(model::product_row(attached, gap, q));
    joint.rows.push_back(model::product_row(attached, attached_vector(1, 2, Vec3::UnitX()), q));
  }
  return joint;
}

}  // namespace culm::joint
