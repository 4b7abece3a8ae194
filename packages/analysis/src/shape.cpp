#include <culm/analysis/shape.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::analysis {
namespace {

using model::NodeSlots;
using model::NodeTable;

// An eliminated node moves as its master does.
Vec6 follow(const NodeTable& nodes, int slave, const model::Coordinates& q, const Vec6& motion) {
  const NodeSlots slots = nodes.slot_motion(nodes.master(slave), motion, q);
  const model::RigidLink& link = nodes.rigid_link(slave);
  NodeSlots follower;
  follower.col(0) = slots.col(0) + slots.rightCols<3>() * link.lever;
  follower.rightCols<3>() = slots.rightCols<3>() * link.turn.transpose();
  return nodes.unknown_motion(slave, follower, q);
}

}  // namespace

std::vector<Vec6> node_motions(const assembly::System& system, const model::State& state,
                               const Eigen::Ref<const Eigen::VectorXd>& unknowns) {
  const model::Model& model = system.model();
  const NodeTable& nodes = model.nodes();
  std::vector<Vec6> motions(static_cast<std::size_t>(nodes.size()), Vec6::Zero());
  for (const model::Block& block : model.unknowns().blocks()) {
    if (block.kind != model::BlockKind::node) continue;
    Vec<12> u = Vec<12>::Zero();
    for (int i = 0; i < block.shape.width; ++i) {
      const int at = block.shape.position[static_cast<std::size_t>(i)];
      if (at >= 0) u[i] = unknowns[block.first + at];
    }
    motions[static_cast<std::size_t>(block.owner)] =
        model.unknowns().form() == model::Form::null_space
            ? Vec6(u.head<6>())
            : nodes.unknown_motion(block.owner, Eigen::Map<const NodeSlots>(u.data()), state.next);
  }
  for (int node = 0; node < nodes.size(); ++node) {
    if (!nodes.is_slave(node)) continue;
    motions[static_cast<std::size_t>(node)] =
        follow(nodes, node, state.next, motions[static_cast<std::size_t>(nodes.master(node))]);
  }
  return motions;
}

model::Coordinates slot_motions(const model::Model& model, const model::State& state,
                                const std::vector<Vec6>& motions) {
  const NodeTable& nodes = model.nodes();
  model::Coordinates slots(state.next.size(), 0.0);
  for (int node = 0; node < nodes.size(); ++node) {
    NodeTable::slots(slots, node) =
        nodes.slot_motion(node, motions[static_cast<std::size_t>(node)], state.next);
  }
  return slots;
}

void displace(const model::Model& model, const Shape& shape, double factor, double phase,
              model::Coordinates& q) {
  const NodeTable& nodes = model.nodes();
  for (int node = 0; node < nodes.size(); ++node) {
    if (nodes.is_slave(node)) continue;
    const auto at = static_cast<std::size_t>(node);
    Vec6 motion = std::cos(phase) * shape.real[at];
    if (!shape.imaginary.empty()) motion -= std::sin(phase) * shape.imaginary[at];
    nodes.move(node, factor * motion, q);
  }
  for (int node = 0; node < nodes.size(); ++node) {
    if (nodes.is_slave(node)) nodes.follow_master(node, q);
  }
}

double visible_factor(const model::Model& model, const Shape& shape) {
  double displacement = 0.0;
  double rotation = 0.0;
  for (const std::vector<Vec6>* part : {&shape.real, &shape.imaginary}) {
    for (const Vec6& motion : *part) {
      displacement = std::max(displacement, motion.head<3>().norm());
      rotation = std::max(rotation, motion.tail<3>().norm());
    }
  }
  double factor = std::numeric_limits<double>::infinity();
  if (displacement > 0.0) factor = 0.1 * model.length() / displacement;
  if (rotation > 0.0) factor = std::min(factor, 0.6 / rotation);
  return std::isfinite(factor) ? factor : 0.0;
}

}  // namespace culm::analysis
