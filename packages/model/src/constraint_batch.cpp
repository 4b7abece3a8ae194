#include <culm/base/error.hpp>
#include <culm/model/constraint_batch.hpp>
#include <culm/model/item_motion.hpp>

#include <algorithm>
#include <cmath>

namespace culm::model {
namespace {

constexpr int max_slots = 4 * ConstraintBatch::max_nodes;
constexpr int max_width = 12 * ConstraintBatch::max_nodes;
constexpr int max_rows = ConstraintBatch::max_rows;

// Sizes vary with the constraint but are bounded, so nothing is on the heap.
using ItemSlots = BoundedSlots<ConstraintBatch::max_nodes>;
using Rows =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, max_width, max_rows>;
using Scalars =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_slots, max_slots>;

Vec3 sum(const SlotSum& factors, const ItemSlots& q) {
  Vec3 result = Vec3::Zero();
  for (int s = 0; s < q.cols(); ++s) result += factors[static_cast<std::size_t>(s)] * q.col(s);
  return result;
}

// Q = w + sum_s beta_s q_s
Vec3 second_factor(const ConstraintRow& row, const ItemSlots& q) {
  return row.linear() ? row.direction : Vec3(row.direction + sum(row.beta, q));
}

double value(const ConstraintRow& row, const ItemSlots& q) {
  return sum(row.alpha, q).dot(second_factor(row, q)) - row.constant;
}

// H^T, one column per row of the constraint: alpha_s Q + beta_s P
Rows gradient(const std::vector<ConstraintRow>& rows, const ItemSlots& q) {
  Rows H(3 * q.cols(), static_cast<int>(rows.size()));
  for (int k = 0; k < H.cols(); ++k) {
    const ConstraintRow& row = rows[static_cast<std::size_t>(k)];
    const Vec3 P = sum(row.alpha, q);
    const Vec3 Q = second_factor(row, q);
    for (int s = 0; s < q.cols(); ++s) {
      const auto at = static_cast<std::size_t>(s);
      Vec3 column = row.alpha[at] * Q;
      if (!row.linear()) column += row.beta[at] * P;
      H.block<3, 1>(3 * s, k) = column;
    }
  }
  return H;
}

// sum_k lambda_k A_k, A_k(i, j) = alpha_i beta_j + beta_i alpha_j for product rows
Scalars curvature(const std::vector<ConstraintRow>& rows, const double* lambda, int slots) {
  Scalars A = Scalars::Zero(slots, slots);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].linear()) continue;
    const Eigen::Map<const Eigen::VectorXd> alpha(rows[k].alpha.data(), slots);
    const Eigen::Map<const Eigen::VectorXd> beta(rows[k].beta.data(), slots);
    for (int i = 0; i < slots; ++i) {
      for (int j = 0; j < slots; ++j) {
        A(i, j) += lambda[k] * (alpha[i] * beta[j] + beta[i] * alpha[j]);
      }
    }
  }
  return A;
}

template <class Space>
Rows reduce(const Rows& H, const ItemMotion<ConstraintBatch::max_nodes>::NodeArms& arms) {
  const int nodes = static_cast<int>(H.rows()) / 12;
  Rows R(Space::width * nodes, H.cols());
  for (int a = 0; a < nodes; ++a) {
    Space::reduce_rows(H.middleRows<12>(12 * a), arms[static_cast<std::size_t>(a)],
                       R.middleRows<Space::width>(Space::width * a));
  }
  return R;
}

bool holds_positions(const ConstraintRow& row) {
  for (std::size_t s = 0; s < row.alpha.size(); s += 4) {
    if (row.alpha[s] != 0.0 || (!row.beta.empty() && row.beta[s] != 0.0)) return true;
  }
  return false;
}

}  // namespace

void ConstraintBatch::add(Constraint constraint, int number) {
  internal_check(constraint.nodes.size() <= max_nodes && constraint.rows.size() <= max_rows,
                 "a constraint is larger than ConstraintBatch provides for");
  Item item;
  item.number = number;
  item.rows_mid = item.rows_next = constraint.rows;
  for (const ConstraintRow& row : constraint.rows) {
    item.measure.push_back(holds_positions(row) ? length_ : 1.0);
  }
  item.constraint = std::move(constraint);
  items_.push_back(std::move(item));
}

std::vector<int> ConstraintBatch::blocks(int item, const UnknownTable& unknowns) const {
  const Item& it = items_[static_cast<std::size_t>(item)];
  std::vector<int> result;
  for (int node : it.constraint.nodes) result.push_back(unknowns.node_block(node));
  result.push_back(unknowns.constraint_block(it.number));
  return result;
}

void ConstraintBatch::number(const UnknownTable& unknowns) {
  for (Item& item : items_) {
    item.first_multiplier = unknowns.block(unknowns.constraint_block(item.number)).first_multiplier;
  }
}

void ConstraintBatch::place(Placement placement, Form form) {
  placement_ = std::move(placement);
  form_ = form;
}

void ConstraintBatch::begin_step(const State& state, const Stencil& stencil) {
  const double time_mid = (1.0 - stencil.theta) * state.time_prev + stencil.theta * state.time;
  for (Item& item : items_) {
    if (!item.constraint.drive) continue;
    item.constraint.drive(time_mid, item.rows_mid);
    item.constraint.drive(state.time, item.rows_next);
  }
}

Verdict ConstraintBatch::assemble(const State& state, const Stencil& stencil, Want want,
                                  Target& target) {
  Verdict verdict = Verdict::ok;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (want == Want::mass) {
      if (form_ == Form::null_space) assemble_jacobian<NullSpace>(i, state, target);
      if (form_ == Form::multipliers) assemble_jacobian<FullSpace>(i, state, target);
      continue;
    }
    const Verdict one = form_ == Form::null_space
                            ? assemble_item<NullSpace>(i, state, stencil, want, target)
                            : assemble_item<FullSpace>(i, state, stencil, want, target);
    verdict = worse(verdict, one);
  }
  return verdict;
}

template <class Space>
Verdict ConstraintBatch::assemble_item(std::size_t i, const State& state, const Stencil& stencil,
                                       Want want, Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
  const std::vector<int>& nodes = item.constraint.nodes;
  const int n = static_cast<int>(nodes.size());
  const int m = static_cast<int>(item.rows_next.size());
  const ItemMotion<max_nodes> motion(nodes_, nodes, state, stencil.theta);
  const Eigen::Map<const Eigen::VectorXd> lambda(state.multipliers.data() + item.first_multiplier,
                                                 m);
  const Rows H_mid = gradient(item.rows_mid, motion.mid);
  const Rows R_mid = reduce<Space>(H_mid, motion.arms_mid);
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_width, 1> force(W * n);
  force.noalias() = R_mid.lazyProduct(lambda);
  if (!std::isfinite(force.sum())) return Verdict::not_finite;
  target.force_scale = std::max(target.force_scale, force.lpNorm<Eigen::Infinity>());
  for (int a = 0; a < n; ++a) {
    placement_.scatter.add_residual(i, a, force.data() + W * a, target);
  }
  std::array<double, max_rows> h{};
  for (int k = 0; k < m; ++k) {
    const auto at = static_cast<std::size_t>(k);
    h[at] = value(item.rows_next[at], motion.next);
    if (!std::isfinite(h[at])) return Verdict::not_finite;
    target.constraint_violation =
        std::max(target.constraint_violation, std::abs(h[at]) / item.measure[at]);
    h[at] *= target.multiplier_scale;
  }
  placement_.scatter.add_residual(i, n, h.data(), target);
  if (want == Want::residual) return Verdict::ok;

  const Rows R_next = reduce<Space>(gradient(item.rows_next, motion.next), motion.arms_next);
  add_border<Space>(i, R_mid, R_next, target);
  add_curvature<Space>(i, motion, H_mid, lambda.data(), stencil.theta, target);
  return Verdict::ok;
}

// The multiplier columns P^T H^T and rows H P, scaled.
template <class Space, class Jacobian>
void ConstraintBatch::add_border(std::size_t i, const Jacobian& columns, const Jacobian& rows,
                                 Target& target) const {
  constexpr int W = Space::width;
  const int n = static_cast<int>(columns.rows()) / W;
  for (int a = 0; a < n; ++a) {
    const Jacobian column = target.multiplier_scale * columns.template middleRows<W>(W * a);
    const Jacobian row = target.multiplier_scale * rows.template middleRows<W>(W * a).transpose();
    placement_.scatter.add_tangent(i, a, n, column, target);
    placement_.scatter.add_tangent(i, n, a, row, target);
  }
}

// theta sum_k lambda_k A_k between the nodes, and the turning of the projection under H^T lambda.
template <class Space, class Motion, class Jacobian>
void ConstraintBatch::add_curvature(std::size_t i, const Motion& motion, const Jacobian& H_mid,
                                    const double* lambda, double theta, Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
  const int n = static_cast<int>(item.constraint.nodes.size());
  const Scalars A = theta * curvature(item.rows_mid, lambda, 4 * n);
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_width, 1> slot_force(12 * n);
  slot_force.noalias() = H_mid.lazyProduct(Eigen::Map<const Eigen::VectorXd>(lambda, H_mid.cols()));
  const Eigen::Map<const ItemSlots> slot_forces(slot_force.data(), 3, 4 * n);
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      RowMat<W, W> block = RowMat<W, W>::Zero();
      const auto& arms_next = motion.arms_next[static_cast<std::size_t>(b)];
      Space::add_pairs(A.template block<4, 4>(4 * a, 4 * b),
                       motion.arms_mid[static_cast<std::size_t>(a)], arms_next, block);
      if (a == b) {
        Space::add_turning(slot_forces.template middleCols<4>(4 * a), arms_next, theta, block);
      }
      placement_.scatter.add_tangent(i, a, b, block, target);
    }
  }
}

// The Jacobian at the end of the step on both sides, as it borders a mass matrix.
template <class Space>
void ConstraintBatch::assemble_jacobian(std::size_t i, const State& state, Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
  const ItemMotion<max_nodes> motion(nodes_, item.constraint.nodes, state, 1.0);
  const Rows R = reduce<Space>(gradient(item.rows_next, motion.next), motion.arms_next);
  add_border<Space>(i, R, R, target);
}

StepWork ConstraintBatch::step_work(const State& state, const Stencil& stencil) const {
  StepWork work;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
    if (!placement_.owned[i] || !item.constraint.drive) continue;
    const std::vector<int>& nodes = item.constraint.nodes;
    const ItemMotion<max_nodes> motion(nodes_, nodes, state, stencil.theta);
    const Rows H = gradient(item.rows_mid, motion.mid);
    ItemSlots moved = motion.next;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      moved.middleCols<4>(4 * static_cast<int>(a)) -= NodeTable::slots(state.prev, nodes[a]);
    }
    // the constraint acts with -H^T lambda
    work.drives -= (H.transpose() * moved.reshaped())
                       .dot(Eigen::Map<const Eigen::VectorXd>(
                           state.multipliers.data() + item.first_multiplier, H.cols()));
  }
  return work;
}

Vec6 ConstraintBatch::reaction(int node, const State& state, const std::string& constraint) const {
  Vec6 total = Vec6::Zero();
  for (const Item& item : items_) {
    if (!constraint.empty() && item.constraint.name != constraint) continue;
    const std::vector<int>& nodes = item.constraint.nodes;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (nodes[a] != node) continue;
      const ItemMotion<max_nodes> motion(nodes_, nodes, state, 1.0);
      const Rows H = gradient(item.rows_next, motion.next);
      const Eigen::Map<const Eigen::VectorXd> lambda(
          state.multipliers.data() + item.first_multiplier, H.cols());
      const int at = static_cast<int>(a);
      const Eigen::VectorXd force = H.middleRows<12>(12 * at) * lambda;
      Arms<4> arms = motion.arms_next[a];
      arms.slots.col(0).setZero();  // the moment is taken about the node
      RowMat<6, 1> reduced;
      NullSpace::reduce_rows(force, arms, reduced);
      total -= reduced;
    }
  }
  return total;
}

}  // namespace culm::model
