#include "turn_before_buckling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

using model::NodeTable;

// A deep cantilever under its tip load then buckles some 6 % later than linear buckling says.
constexpr double small_turn = 0.1;  // [rad]

// Of the directors of a node per unit of a motion [rad].
double turn_of(const model::Model& model, int node, const model::Coordinates& q,
               const model::Coordinates& motion) {
  const NodeTable& nodes = model.nodes();
  const model::NodeSlots slots = NodeTable::slots(motion, node);
  if (nodes.kind(node) != NodeKind::node6) {
    return nodes.unknown_motion(node, slots, q).tail<3>().norm();
  }
  const Vec3 director = NodeTable::slots(q, node).col(1);
  return director.cross(Vec3(slots.col(1))).norm() / director.squaredNorm();
}

}  // namespace

void warn_of_turns(const model::Model& model, const model::Coordinates& q,
                   const model::Coordinates& motion, double factor, double level,
                   Findings& findings) {
  double turn = 0.0;
  int most_turned = 0;
  for (int node = 0; node < model.nodes().size(); ++node) {
    const double found = turn_of(model, node, q, motion);
    if (found > turn) most_turned = node;
    turn = std::max(turn, found);
  }
  const double way = std::abs(factor) * turn;
  if (way <= small_turn) return;
  findings.warn(
      "turn before buckling",
      fmt::format("mode 1, factor {:.5g}: the linear response to so much of the reference load "
                  "turns '{}' by {:.2g} rad, and linear buckling leaves out that the structure "
                  "moves before it buckles: factors are good where such turns are below {:g} rad. "
                  "A static analysis before this one to most of the load, or a 'Path', knows the "
                  "way",
                  factor, model.node_name(most_turned), way, small_turn),
      level);
}

}  // namespace culm::analysis
