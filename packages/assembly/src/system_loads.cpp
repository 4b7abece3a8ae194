#include <culm/assembly/system.hpp>

#include "block_values.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <map>

namespace culm::assembly {
namespace {

// How h of a row changes with the slots of its only node.
model::NodeSlots slot_gradient(const model::ConstraintRow& row, const model::NodeSlots& q) {
  const Eigen::Map<const Eigen::RowVector4d> alpha(row.alpha.data());
  if (row.linear()) return row.direction * alpha;
  const Eigen::Map<const Eigen::RowVector4d> beta(row.beta.data());
  const Vec3 P = q * alpha.transpose();
  const Vec3 Q = row.direction + q * beta.transpose();
  return Q * alpha + P * beta;
}

// The directions in the unknowns of each node in which equations on it alone hold it.
std::map<int, Eigen::MatrixXd> held_directions(const model::Model& model,
                                               const model::Coordinates& q) {
  std::map<int, Eigen::MatrixXd> held;
  for (const model::Constraint& c : model.equations()) {
    if (c.nodes.size() != 1) continue;
    const model::UnknownTable& unknowns = model.unknowns();
    const int node = c.nodes.front();
    const model::Block& block = unknowns.block(unknowns.node_block(node));
    if (block.owner != node) continue;  // it follows another node
    Eigen::MatrixXd& directions = held[block.owner];
    for (const model::ConstraintRow& row : c.rows) {
      const model::NodeSlots gradient = slot_gradient(row, model::NodeTable::slots(q, node));
      directions.conservativeResize(block.shape.active, directions.cols() + 1);
      for (int i = 0; i < block.shape.width; ++i) {
        const int at = block.shape.position[index(i)];
        if (at < 0) continue;
        std::array<double, 12> unit{};
        unit[index(i)] = 1.0;
        directions(at, directions.cols() - 1) =
            gradient.cwiseProduct(slot_motion(model, node, unit, q)).sum();
      }
    }
  }
  return held;
}

// What forces on the unknowns of a node amount to; those on a director do so by its arm.
Vec6 force_and_moment(const model::Model& model, int node, const model::NodeSlots& q,
                      const double* unknowns) {
  Vec6 sum = Vec6::Zero();
  sum.head<3>() = Eigen::Map<const Vec3>(unknowns);
  if (model.unknowns().form() == model::Form::null_space && model.nodes().turns(node)) {
    sum.tail<3>() = Eigen::Map<const Vec3>(unknowns + 3);
    return sum;
  }
  for (int director = 1; director <= 3; ++director) {
    sum.tail<3>() +=
        Vec3(q.col(director)).cross(Vec3(Eigen::Map<const Vec3>(unknowns + 3 * director)));
  }
  return sum;
}

}  // namespace

void System::assemble_alone(model::Batch& load, const model::State& state,
                            std::span<double> residual, std::span<double> taken) const {
  model::Target target;
  target.residual = residual;
  target.reactions = taken;
  target.row_begin = matrix_->row_begin();
  load.assemble(state, Stencil::statics(), Want::residual, target);
}

LoadShare System::share_of(model::Batch& load, const model::State& state) const {
  Vector forces(layout_.rows());
  const auto residual = forces.values();
  std::vector<double> taken(reactions_.size(), 0.0);
  assemble_alone(load, state, residual, taken);
  LoadShare share;
  for (const double force : taken) share.whole = std::max(share.whole, std::abs(force));
  for (const double force : residual) share.whole = std::max(share.whole, std::abs(force));
  share.whole = comm_.max(share.whole);
  if (share.whole == 0.0) return share;  // it does not act now
  const auto held = held_directions(model_, state.next);
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block& block = model_.unknowns().block(local.block);
    if (!local.owned || block.kind != model::BlockKind::node || block.shape.active == 0) continue;
    Eigen::VectorXd f =
        Eigen::Map<const Eigen::VectorXd>(residual.data() + local.first_column, block.shape.active);
    const auto at = held.find(block.owner);
    if (at != held.end()) {
      const Eigen::MatrixXd& directions = at->second;
      f -= directions * directions.colPivHouseholderQr().solve(f);
    }
    share.moving = std::max(share.moving, f.lpNorm<Eigen::Infinity>());
  }
  share.moving = comm_.max(share.moving);
  return share;
}

std::vector<Vec6> System::forces_of(model::Batch& load, const model::State& state) const {
  Vector forces(layout_.rows());
  const auto residual = forces.values();
  std::vector<double> taken(reactions_.size(), 0.0);
  assemble_alone(load, state, residual, taken);
  std::vector<double> all(12 * index(model_.nodes().size()), 0.0);  // unknowns of nodes
  const auto each_unknown = [&](const model::Block& block, auto action) {
    if (block.kind != model::BlockKind::node) return;
    for (int i = 0; i < block.shape.width; ++i) {
      action(all[12 * index(block.owner) + index(i)], block.shape.position[index(i)]);
    }
  };
  for (const model::Block& block : model_.unknowns().blocks()) {
    each_unknown(block, [&](double& force, int at) {
      if (at < 0) force = -taken[index(block.shape.first_reaction - 1 - at)];
    });
  }
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    if (!local.owned) continue;
    each_unknown(model_.unknowns().block(local.block), [&](double& force, int at) {
      if (at >= 0) force = -residual[index(local.first_column + at)];
    });
  }
  comm_.sum(all);
  std::vector<Vec6> found;
  for (int node = 0; node < model_.nodes().size(); ++node) {
    const auto slots = model::NodeTable::slots(state.next, node);
    found.push_back(force_and_moment(model_, node, slots, all.data() + 12 * node));
  }
  return found;
}

}  // namespace culm::assembly
