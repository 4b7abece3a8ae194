/// The laws every constraint obeys, as one test suite with a parameter. A test file brings them all
/// by a line:
///
///     INSTANTIATE_TEST_SUITE_P(Ball, ConstraintContract,
///                              testing::Values(subject<BallCase>("Ball")), name_of_subject);
///
/// where the case says how to make the constraint:
///
///     struct BallCase {
///       static constexpr int num_nodes = 2;
///       static constexpr bool eliminated = false;   // by the null-space form
///       static model::Constraint make(const model::NodeTable& nodes);  // of nodes 0, 1, …
///     };
///
/// Nodes have random positions and triads, or are of the kind that `node_kind` says (kind_of).
/// JointContract adds what joints between bodies obey.
/// @source formulation 0.3, 2.1, 2.8, 6.4
#pragma once

#include <culm/model/constraint.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/dense_assembly.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace culm::kit {

/// What the laws know of a constraint; compiled once for all, not for each case.
struct ConstraintSubject {
  std::string name;
  std::vector<NodeKind> node_kinds;
  bool eliminated = false;  // by the null-space form
  model::Constraint (*make)(const model::NodeTable&) = nullptr;

  friend std::ostream& operator<<(std::ostream& out, const ConstraintSubject& subject) {
    return out << subject.name;
  }
};

template <class Case>
ConstraintSubject subject(std::string name) {
  ConstraintSubject subject{std::move(name), {}, Case::eliminated, &Case::make};
  for (int node = 0; node < Case::num_nodes; ++node) {
    subject.node_kinds.push_back(kind_of<Case>(node));
  }
  return subject;
}

inline std::string name_of_subject(const testing::TestParamInfo<ConstraintSubject>& info) {
  return info.param.name;
}

/// The rows of a constraint as ConstraintBatch evaluates them: in the multiplier form h is the
/// residual of its own rows, and H their tangent.
class ConstraintContract : public testing::TestWithParam<ConstraintSubject> {
 protected:
  static constexpr const char* name = "tested";

  ConstraintContract() {
    fill(rows_model_, false);
    rows_model_.freeze(model::Form::multipliers);
    rows_ = std::make_unique<DenseAssembly>(rows_model_);
    const model::UnknownTable& unknowns = rows_model_.unknowns();
    first_row_ = unknowns.block(unknowns.constraint_block(0)).first;
    num_rows_ = unknowns.block(unknowns.constraint_block(0)).shape.width;
  }

  static int num_nodes() { return static_cast<int>(GetParam().node_kinds.size()); }
  static int width() { return 12 * num_nodes(); }
  static NodeKind kind(int node) { return GetParam().node_kinds[static_cast<std::size_t>(node)]; }

  static void add_nodes(model::Model& model) {
    for (int node = 0; node < num_nodes(); ++node) {
      add_random_node(model.nodes(), kind(node), 10 + node);
    }
  }
  /// The constraint, kept as equations, and on demand a master that node 0 follows.
  static void fill(model::Model& model, bool with_slave) {
    add_nodes(model);
    model::Constraint constraint = GetParam().make(model.nodes());
    constraint.name = constraint.type = name;
    constraint.fix.reset();
    constraint.link.reset();
    model.keep_redundant_rows();
    model.add_constraint(std::move(constraint));
    if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(random_node(20)));
  }

  model::State state_at(const model::Coordinates& q) const {
    model::State state = rows_model_.initial_state();
    state.prev = state.next = q;
    return state;
  }
  /// h(q) at time zero
  Eigen::VectorXd h(const model::Coordinates& q) {
    return rows_->residual(state_at(q), Stencil::statics()).segment(first_row_, num_rows_);
  }
  /// H(q) at time zero, shape (rows, 12 nodes)
  Eigen::MatrixXd H(const model::Coordinates& q) {
    const Eigen::MatrixXd K = rows_->tangent(state_at(q), Stencil::statics());
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(num_rows_, width());
    for (int node = 0; node < num_nodes(); ++node) {
      const model::UnknownTable& unknowns = rows_model_.unknowns();
      const model::Block& block = unknowns.block(unknowns.node_block(node));
      H.middleCols(12 * node, block.shape.width) =
          K.block(first_row_, block.first, num_rows_, block.shape.width);
    }
    return H;
  }

  const model::NodeTable& nodes() const { return rows_model_.nodes(); }
  const model::Coordinates& reference() const { return nodes().reference(); }
  /// Any slots, admissible or not.
  static model::Coordinates any(int seed) {
    Random random(seed);
    model::Coordinates q(static_cast<std::size_t>(width()));
    for (double& value : q) value = random.number();
    for (int node = 0; node < num_nodes(); ++node) {
      const int slots = slots_of(kind(node));
      model::NodeTable::slots(q, node).rightCols(4 - slots).setZero();
    }
    return q;
  }
  /// The reference moved as one rigid body.
  model::Coordinates moved(int seed) const {
    const RigidMotion motion = RigidMotion::random(seed);
    model::Coordinates q = reference();
    for (int node = 0; node < num_nodes(); ++node) {
      auto slots = model::NodeTable::slots(q, node);
      slots = motion(Slots<4>(slots), NodeKind::node12);
    }
    return q;
  }
  static Eigen::Map<const Eigen::VectorXd> flat(const model::Coordinates& q) {
    return {q.data(), static_cast<Eigen::Index>(q.size())};
  }
  static long rank(const Eigen::MatrixXd& m) {
    return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(m.transpose()).setThreshold(1e-10).rank();
  }

  /// Gradient of the six internal constraints of a node, written out from formulation 2.2; a node
  /// of a shell has none.
  static Eigen::MatrixXd internal_gradient(const model::Coordinates& q, int node) {
    if (kind(node) == NodeKind::node6) return Eigen::MatrixXd::Zero(0, width());
    const Mat3 d = model::NodeTable::slots(q, node).rightCols<3>();
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6, width());
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      const int at = 12 * node + 3;
      H.block<1, 3>(i, at + 3 * i) = d.col(i).transpose();
      H.block<1, 3>(3 + i, at + 3 * j) = d.col(k).transpose();
      H.block<1, 3>(3 + i, at + 3 * k) = d.col(j).transpose();
    }
    return H;
  }

  static constexpr double round_off = 1e-14;  // some tens of operations with numbers up to 3

 private:
  model::Model rows_model_;
  std::unique_ptr<DenseAssembly> rows_;
  int first_row_ = 0;
  int num_rows_ = 0;
};

TEST_P(ConstraintContract, HoldsInTheReference) { EXPECT_LT(largest(h(reference())), round_off); }

TEST_P(ConstraintContract, GradientIsDerivativeOfTheRows) {
  const model::Coordinates q = any(1);
  const Eigen::MatrixXd H = this->H(q);
  constexpr double step = 0.25;  // central differences of quadratic forms are exact
  for (std::size_t i = 0; i < q.size(); ++i) {
    model::Coordinates ahead = q;
    model::Coordinates behind = q;
    ahead[i] += step;
    behind[i] -= step;
    const Eigen::VectorXd difference = (h(ahead) - h(behind)) / (2.0 * step);
    EXPECT_LT(largest(H.col(static_cast<Eigen::Index>(i)) - difference), round_off);
  }
}

// h(q1) - h(q0) = H(q_1/2) (q1 - q0): constraint forces do no work
TEST_P(ConstraintContract, IncrementIsMidpointGradientTimesMotion) {
  model::State state;
  state.prev = any(1);
  state.next = any(2);
  const Eigen::VectorXd increment = H(at_theta(state, 0.5)) * (flat(state.next) - flat(state.prev));
  EXPECT_LT(largest(h(state.next) - h(state.prev) - increment), round_off);
}

TEST_P(ConstraintContract, RowsAreIndependentOfTheInternalOnesTheyDoNotReplace) {
  const model::Coordinates& q = reference();
  const int replaced = GetParam().make(nodes()).replaces_internal;
  Eigen::MatrixXd kept = H(q);
  Eigen::MatrixXd all = kept;
  for (int node = 0; node < num_nodes(); ++node) {
    const Eigen::MatrixXd internal = internal_gradient(q, node);
    const Eigen::MatrixXd before = all;
    all.resize(before.rows() + internal.rows(), width());
    all << before, internal;
    if (node == replaced) continue;
    const Eigen::MatrixXd kept_before = kept;
    kept.resize(kept_before.rows() + internal.rows(), width());
    kept << kept_before, internal;
  }
  EXPECT_EQ(rank(kept), kept.rows());
  EXPECT_EQ(rank(all), kept.rows());  // the replaced ones are implied
}

TEST_P(ConstraintContract, EliminationLeavesTheMotionsThatTheRowsLeave) {
  model::Model model;
  add_nodes(model);
  model.add_constraint(GetParam().make(model.nodes()));
  model.freeze(model::Form::null_space);
  ASSERT_EQ(model.equations().empty(), GetParam().eliminated);
  if (!GetParam().eliminated) return;
  // as many unknowns are gone as there are independent reduced rows
  const Eigen::MatrixXd P = null_space_matrix(nodes(), reference());
  const DenseAssembly dense(model);
  EXPECT_EQ(dense.size(), P.cols() - rank(H(reference()) * P));
  // and what is left moves without breaking a row
  model::State state = model.initial_state();
  Random random(6);
  for (int i = 0; i < 3; ++i) {
    dense.move(state, Eigen::VectorXd::NullaryExpr(dense.size(), [&] { return random.number(); }));
    EXPECT_LT(largest(h(state.next)), round_off);
  }
}

TEST_P(ConstraintContract, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    expect_tangent_is_derivative([&](model::Model& model) { fill(model, with_slave); }, name);
  }
}

TEST_P(ConstraintContract, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    expect_residual_is_projected([&](model::Model& model) { fill(model, with_slave); }, name);
  }
}

TEST_P(ConstraintContract, AssembleAllocatesNothing) {
  expect_no_allocation([&](model::Model& model) { fill(model, true); }, name);
}

TEST_P(ConstraintContract, AttemptsLeaveNoTrace) {
  expect_attempts_leave_no_trace([&](model::Model& model) { fill(model, true); }, name);
}

class JointContract : public ConstraintContract {};

TEST_P(JointContract, HoldsUnderRigidMotion) { EXPECT_LT(largest(h(moved(1))), 10.0 * round_off); }

// At q_1/2 of a step between admissible ends H^T lambda has no resultant force and moment: the
// joint keeps the momenta.
TEST_P(JointContract, ForcesBalance) {
  model::State state;
  state.prev = moved(1);
  state.next = moved(2);
  const model::Coordinates q = at_theta(state, 0.5);
  const Eigen::MatrixXd H = this->H(q);
  for (Eigen::Index row = 0; row < H.rows(); ++row) {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (int slot = 0; slot < 4 * num_nodes(); ++slot) {
      const Vec3 f = H.block<1, 3>(row, 3 * slot).transpose();
      const Vec3 arm = Eigen::Map<const Vec3>(q.data() + 3 * slot);
      if (slot % 4 == 0) force += f;
      moment += skew(arm) * f;
    }
    EXPECT_LT(force.norm(), round_off);
    EXPECT_LT(moment.norm(), round_off);
  }
}

}  // namespace culm::kit
