/// A model assembled on one rank into dense matrices, without Tpetra: for tests of batches.
#pragma once

#include <culm/model/model.hpp>

#include <Eigen/Dense>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace culm::kit {

/// A node anywhere, with any triad.
inline model::NodeSlots random_node(int seed) {
  Random random(seed);
  model::NodeSlots slots;
  slots << random.vector(), random.rotation();
  return slots;
}

/// A node of a shell anywhere, its director of any direction and not of length one.
inline model::NodeSlots random_shell_node(int seed) {
  Random random(seed);
  model::NodeSlots slots = model::NodeSlots::Zero();
  slots.col(0) = random.vector();
  slots.col(1) = (1.0 + 0.3 * random.number()) * random.rotation().col(2);
  return slots;
}

/// Adds a random node of a kind.
inline int add_random_node(model::NodeTable& nodes, NodeKind kind, int seed) {
  return nodes.add(kind == NodeKind::node6 ? random_shell_node(seed) : random_node(seed), kind);
}

/// Makes eliminated nodes follow their masters.
inline void follow_masters(const model::NodeTable& nodes, model::Coordinates& q) {
  for (int node = 0; node < nodes.size(); ++node) {
    if (nodes.is_slave(node)) nodes.follow_master(node, q);
  }
}

/// Places the batches of a frozen model in one dense system: every row has all columns.
class DenseAssembly {
 public:
  using Batches = std::vector<model::Batch*>;

  explicit DenseAssembly(model::Model& model) : model_(model) {
    const auto size = static_cast<std::size_t>(this->size());
    for (std::size_t row = 0; row <= size; ++row) row_begin_.push_back(row * size);
    residual_.resize(size);
    values_.resize(size * size);
    for (model::Batch* batch : model.batches()) {
      batch->place(place(*batch), model.unknowns().form());
    }
  }

  int size() const { return model_.unknowns().num_unknowns(); }

  const model::Model& model() const { return model_; }

  /// Begins an attempt of all batches at the given state.
  void prepare(const model::State& state, const Stencil& stencil) {
    for (model::Batch* batch : model_.batches()) batch->prepare(state, stencil);
  }
  /// Ends a step of all batches, in which the state was evaluated last.
  void accept(model::State& state) {
    for (model::Batch* batch : model_.batches()) batch->accept(state);
  }

  /// Residual of some batches, of all when none are named.
  Eigen::VectorXd residual(const model::State& state, const Stencil& stencil,
                           const Batches& batches = {}) {
    EXPECT_EQ(assemble(state, stencil, Want::residual, chosen(batches)), Verdict::ok);
    return Eigen::Map<Eigen::VectorXd>(residual_.data(), size());
  }

  /// Tangent of some batches, of all when none are named.
  Eigen::MatrixXd tangent(const model::State& state, const Stencil& stencil,
                          const Batches& batches = {}) {
    EXPECT_EQ(assemble(state, stencil, Want::residual_and_tangent, chosen(batches)), Verdict::ok);
    return Eigen::Map<RowMatrix>(values_.data(), size(), size());
  }

  /// Derivative of the residual by the unknowns of the end of the step, by differences of fourth
  /// order: error h^4 / 30 = 5e-13 times the fifth derivative, round-off epsilon / h = 1e-13.
  Eigen::MatrixXd difference_tangent(const model::State& state, const Stencil& stencil,
                                     const Batches& batches = {}, double h = 2e-3) {
    Eigen::MatrixXd derivative(size(), size());
    for (int k = 0; k < size(); ++k) {
      const auto at = [&](double step) {
        model::State moved = state;
        move(moved, step * Eigen::VectorXd::Unit(size(), k));
        return residual(moved, stencil, batches);
      };
      derivative.col(k) = (at(-2.0 * h) - 8.0 * at(-h) + 8.0 * at(h) - at(2.0 * h)) / (12.0 * h);
    }
    return derivative;
  }

  /// Moves the trial state as the solver does: nodes multiplicatively in the null-space form.
  void move(model::State& state, const Eigen::VectorXd& increment) const {
    for (const model::Block& block : model_.unknowns().blocks()) {
      Eigen::VectorXd u = Eigen::VectorXd::Zero(block.shape.width);
      for (int i = 0; i < block.shape.width; ++i) {
        const int at = block.shape.position[static_cast<std::size_t>(i)];
        if (at >= 0) u[i] = increment[block.first + at];
      }
      move_block(block, u, state);
    }
    follow_masters(model_.nodes(), state.next);
  }

  /// One pass over the batches, without heap of its own.
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   const Batches& batches) {
    model::Target target;
    target.residual = residual_;
    target.row_begin = row_begin_;
    std::fill(residual_.begin(), residual_.end(), 0.0);
    std::fill(values_.begin(), values_.end(), 0.0);
    if (want == Want::residual_and_tangent) target.values = values_;
    Verdict verdict = Verdict::ok;
    for (model::Batch* batch : batches) {
      verdict = worse(verdict, batch->assemble(state, stencil, want, target));
    }
    return verdict;
  }

 private:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Batches chosen(const Batches& batches) const {
    return batches.empty() ? model_.batches() : batches;
  }

  model::Placement place(const model::Batch& batch) const {
    const model::UnknownTable& unknowns = model_.unknowns();
    model::Placement placement;
    placement.items.resize(static_cast<std::size_t>(batch.size()));
    std::iota(placement.items.begin(), placement.items.end(), 0);
    placement.owned.assign(placement.items.size(), true);
    for (int item : placement.items) {
      const std::vector<int> blocks = batch.blocks(item, unknowns);
      std::vector<model::Scatter::Rows> rows;
      std::vector<int> offsets;
      for (int a : blocks) {
        rows.push_back({unknowns.block(a).first, &unknowns.block(a).shape});
        for (int b : blocks) offsets.push_back(unknowns.block(b).first);
      }
      placement.scatter.add_item(rows, offsets);
    }
    return placement;
  }

  void move_block(const model::Block& block, const Eigen::VectorXd& u, model::State& state) const {
    if (block.kind == model::BlockKind::multipliers) {
      for (int i = 0; i < u.size(); ++i) {
        state.multipliers[static_cast<std::size_t>(block.first_value + i)] += u[i];
      }
    } else if (block.kind == model::BlockKind::own) {
      const auto& own = model_.own_blocks()[static_cast<std::size_t>(block.owner)].unknowns;
      for (int i = 0; i < u.size(); ++i) {
        const model::OwnUnknown& unknown = own[static_cast<std::size_t>(i)];
        const double scale = unknown.kind == model::UnknownKind::multiplier ? 1.0 : unknown.scale;
        state.own[static_cast<std::size_t>(block.first_value + i)] += scale * u[i];
      }
    } else if (model_.unknowns().form() == model::Form::multipliers) {
      Eigen::Map<Eigen::VectorXd>(model::NodeTable::slots(state.next, block.owner).data(),
                                  u.size()) += u;
    } else if (block.shape.active > 0) {
      model_.nodes().move(block.owner, u, state.next);
    }
  }

  model::Model& model_;
  std::vector<std::size_t> row_begin_;
  std::vector<double> residual_;
  std::vector<double> values_;
};

/// A step in the middle of a motion: both ends admissible and far from the reference, all
/// multipliers and inertia at work.
inline model::State random_state(const model::Model& model, int seed) {
  Random random(seed);
  model::State state = model.initial_state();
  state.time_prev = 0.3;
  state.time = 0.7;
  for (model::Coordinates* q : {&state.prev, &state.next}) {
    for (int node = 0; node < model.nodes().size(); ++node) {
      auto slots = model::NodeTable::slots(*q, node);
      slots.col(0) += 0.5 * random.vector();
      slots.rightCols<3>() = random.rotation(0.8) * slots.rightCols<3>();
      if (model.nodes().kind(node) == NodeKind::node6) slots.col(1) *= 1.0 + 0.2 * random.number();
    }
    follow_masters(model.nodes(), *q);
  }
  for (double& lambda : state.multipliers) lambda = random.number();
  for (std::vector<double>* own : {&state.own_prev, &state.own}) {
    for (double& value : *own) value = random.number();
  }
  Random rates(seed + 100);  // the same in both forms, whatever the number of multipliers
  for (model::Coordinates* v : {&state.velocity, &state.acceleration_offset}) {
    v->resize(state.next.size());
    for (double& component : *v) component = rates.number();
  }
  return state;
}

/// The configuration at theta.
inline model::Coordinates at_theta(const model::State& state, double theta) {
  model::Coordinates q = state.next;
  for (std::size_t i = 0; i < q.size(); ++i) {
    q[i] = (1.0 - theta) * state.prev[i] + theta * q[i];
  }
  return q;
}

/// P of formulation 6.1 and 6.4 for all nodes, shape (12 nodes, 6 nodes); columns of eliminated
/// nodes are zero. Written from slots = Lq x master slots, not from arms as the batches are.
inline Eigen::MatrixXd null_space_matrix(const model::NodeTable& nodes,
                                         const model::Coordinates& q) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(12 * nodes.size(), 6 * nodes.size());
  for (int node = 0; node < nodes.size(); ++node) {
    const int master = nodes.master(node);
    const model::NodeSlots m = model::NodeTable::slots(q, master);
    Eigen::Matrix<double, 12, 6> P_m = Eigen::Matrix<double, 12, 6>::Zero();
    P_m.topLeftCorner<3, 3>().setIdentity();
    const bool turns = nodes.kind(master) == NodeKind::node12;
    if (!turns) P_m.block<3, 3>(3, 3).setIdentity();
    for (int i = 0; turns && i < 3; ++i) P_m.block<3, 3>(3 + 3 * i, 3) = -skew(m.col(1 + i));
    Eigen::Matrix4d Lq = Eigen::Matrix4d::Identity();
    if (master != node) {
      Lq.topRightCorner<1, 3>() = nodes.rigid_link(node).lever.transpose();
      Lq.bottomRightCorner<3, 3>() = nodes.rigid_link(node).turn;
    }
    for (int s = 0; s < 4; ++s) {
      for (int t = 0; t < 4; ++t) {
        P.block<3, 6>(12 * node + 3 * s, 6 * master) += Lq(s, t) * P_m.middleRows<3>(3 * t);
      }
    }
  }
  return P;
}

}  // namespace culm::kit
