#include <culm/base/error.hpp>
#include <culm/model/constraint_batch.hpp>
#include <culm/model/item_motion.hpp>
#include <culm/model/product_sum.hpp>
#include <culm/model/signal_column.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace culm::model {
namespace {

constexpr int max_slots = 4 * ConstraintBatch::max_nodes;
constexpr int max_rows = ConstraintBatch::max_rows;

// Sizes vary with the constraint but are bounded, so nothing is on the heap.
using ItemSlots = BoundedSlots<ConstraintBatch::max_nodes>;
using Scalars =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_slots, max_slots>;

// The factors of a sum for the four slots of node a; of product t, those at the place t nodes + a.
Eigen::Map<const Vec<4>> of_node(const SlotSum& factors, int a) {
  return Eigen::Map<const Vec<4>>(factors.data() + 4 * a);
}

// The sum of product t.
Vec3 sum(const SlotSum& factors, const ItemSlots& q, int t = 0) {
  Vec3 result = Vec3::Zero();
  const int nodes = static_cast<int>(q.cols()) / 4;
  for (int a = 0; a < nodes; ++a) {
    result += q.middleCols<4>(4 * a).lazyProduct(of_node(factors, t * nodes + a));
  }
  return result;
}

// The factors of the products of a row, P and Q, in a configuration.
struct RowFactors {
  struct Product {
    Vec3 P;
    Vec3 Q;
  };
  std::array<Product, max_products> products;
  int size;   // products that there are
  int nodes;  // of the constraint

  double value(const ConstraintRow& row) const {
    double h = -row.constant;
    for (int t = 0; t < size; ++t) {
      const Product& one = products[static_cast<std::size_t>(t)];
      h += one.P.dot(one.Q);
    }
    return h;
  }
};

using ItemFactors = std::array<RowFactors, max_rows>;

ItemFactors factors_of(const std::vector<ConstraintRow>& rows, const ItemSlots& q) {
  ItemFactors factors;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    RowFactors& row = factors[k];
    row.nodes = static_cast<int>(q.cols()) / 4;
    row.size = number_of_products(rows[k], row.nodes);
    row.products[0] = {sum(rows[k].alpha, q), rows[k].direction};
    if (rows[k].linear()) continue;
    row.products[0].Q += sum(rows[k].beta, q);
    for (int t = 1; t < row.size; ++t) {
      row.products[static_cast<std::size_t>(t)] = {sum(rows[k].alpha, q, t),
                                                   sum(rows[k].beta, q, t)};
    }
  }
  return factors;
}

// H^T of one row by the slots of node a: sum_t alpha_ts Q_t + beta_ts P_t
NodeSlots slot_gradient(const ConstraintRow& row, const RowFactors& f, int a) {
  NodeSlots g = NodeSlots::Zero();
  for (int t = 0; t < f.size; ++t) {
    const RowFactors::Product& one = f.products[static_cast<std::size_t>(t)];
    const int place = t * f.nodes + a;
    g += one.Q * of_node(row.alpha, place).transpose();
    if (!row.linear()) g += one.P * of_node(row.beta, place).transpose();
  }
  return g;
}

// sum_s factor_s Q on a node that turns: force and moment.
Vec6 turning_gradient(const Eigen::Map<const Vec<4>>& factors, const Vec3& Q, const Arms<4>& arms) {
  Vec6 g;
  g << factors[0] * Q, Vec3(arms.slots.lazyProduct(factors)).cross(Q);
  return g;
}

// P^T H^T of one row for node a. Where a node turns its arms are summed first, as
// sum_s arm_s x alpha_s Q = (sum_s alpha_s arm_s) x Q.
template <class Space>
Vec<Space::width> gradient(const ConstraintRow& row, const RowFactors& f, int a,
                           const Arms<4>& arms) {
  if constexpr (Space::form == Form::null_space) {
    if (arms.turns) {
      Vec6 g = Vec6::Zero();
      for (int t = 0; t < f.size; ++t) {
        const RowFactors::Product& one = f.products[static_cast<std::size_t>(t)];
        const int place = t * f.nodes + a;
        g += turning_gradient(of_node(row.alpha, place), one.Q, arms);
        if (!row.linear()) g += turning_gradient(of_node(row.beta, place), one.P, arms);
      }
      return g;
    }
  }
  return slot_gradient(row, f, a).reshaped().template head<Space::width>();
}

// P^T H^T of all rows by node, shape (width, rows) each.
template <class Space>
class ConstraintJacobian {
 public:
  using Block =
      Eigen::Matrix<double, Space::width, Eigen::Dynamic, Eigen::ColMajor, Space::width, max_rows>;

  ConstraintJacobian(const std::vector<ConstraintRow>& rows, const ItemFactors& factors, int nodes,
                     const ItemMotion<ConstraintBatch::max_nodes>::NodeArms& arms)
      : nodes_(nodes) {
    const int m = static_cast<int>(rows.size());
    for (int a = 0; a < nodes; ++a) {
      const auto at = static_cast<std::size_t>(a);
      blocks_[at].resize(Space::width, m);
      for (int k = 0; k < m; ++k) {
        const auto row = static_cast<std::size_t>(k);
        blocks_[at].col(k) = gradient<Space>(rows[row], factors[row], a, arms[at]);
      }
    }
  }

  int nodes() const { return nodes_; }
  const Block& of(int a) const { return blocks_[static_cast<std::size_t>(a)]; }

 private:
  int nodes_;
  std::array<Block, ConstraintBatch::max_nodes> blocks_;
};

// H^T lambda, the forces on the slots of the nodes side by side
ItemSlots slot_forces(const std::vector<ConstraintRow>& rows, const ItemFactors& factors, int nodes,
                      const double* lambda) {
  ItemSlots force = ItemSlots::Zero(3, 4 * nodes);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (int t = 0; t < factors[k].size; ++t) {
      const RowFactors::Product& one = factors[k].products[static_cast<std::size_t>(t)];
      const Vec3 P = lambda[k] * one.P;
      const Vec3 Q = lambda[k] * one.Q;
      for (int a = 0; a < nodes; ++a) {
        auto on_node = force.middleCols<4>(4 * a);
        const int place = t * nodes + a;
        on_node.noalias() += Q.lazyProduct(of_node(rows[k].alpha, place).transpose());
        if (rows[k].linear()) continue;
        on_node.noalias() += P.lazyProduct(of_node(rows[k].beta, place).transpose());
      }
    }
  }
  return force;
}

// sum_k lambda_k A_k, A_k(i, j) = alpha_i beta_j + beta_i alpha_j for each product
Scalars curvature(const std::vector<ConstraintRow>& rows, const double* lambda, int slots) {
  Scalars A = Scalars::Zero(slots, slots);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].linear()) continue;
    for (int t = 0; t < number_of_products(rows[k], slots / 4); ++t) {
      const Eigen::Map<const Eigen::VectorXd> alpha(rows[k].alpha.data() + t * slots, slots);
      const Eigen::Map<const Eigen::VectorXd> beta(rows[k].beta.data() + t * slots, slots);
      for (int i = 0; i < slots; ++i) {
        for (int j = 0; j < slots; ++j) {
          A(i, j) += lambda[k] * (alpha[i] * beta[j] + beta[i] * alpha[j]);
        }
      }
    }
  }
  return A;
}

bool holds_positions(const ConstraintRow& row) {
  for (std::size_t s = 0; s < row.alpha.size(); s += 4) {
    if (row.alpha[s] != 0.0 || (!row.beta.empty() && row.beta[s] != 0.0)) return true;
  }
  return false;
}

}  // namespace

void ConstraintBatch::add(const Constraint& constraint, int number) {
  internal_check(constraint.nodes.size() <= max_nodes && constraint.rows.size() <= max_rows,
                 "a constraint is larger than ConstraintBatch provides for");
  Item item;
  item.constraint = &constraint;
  item.number = number;
  for (const ConstraintRow& row : constraint.rows) {
    item.measure.push_back(holds_positions(row) ? length_ : 1.0);
  }
  if (constraint.is_driven()) item.moved_mid = item.moved_next = constraint.rows;
  if (constraint.follow) item.slopes_mid = item.slopes_next = constraint.rows;
  if (constraint.drive) driven_.push_back(items_.size());
  items_.push_back(std::move(item));
}

std::vector<int> ConstraintBatch::blocks(int item, const UnknownTable& unknowns) const {
  const Item& it = items_[static_cast<std::size_t>(item)];
  std::vector<int> result;
  for (int node : it.constraint->nodes) result.push_back(unknowns.node_block(node));
  result.push_back(unknowns.constraint_block(it.number));
  if (it.constraint->follow) {
    result.push_back(unknowns.own_block(it.constraint->follow->signal.block));
  }
  return result;
}

void ConstraintBatch::number(const UnknownTable& unknowns) {
  for (Item& item : items_) {
    item.first_multiplier = unknowns.block(unknowns.constraint_block(item.number)).first_value;
  }
}

void ConstraintBatch::place(Placement placement, Form form) {
  placement_ = std::move(placement);
  form_ = form;
  followers_.clear();
  points_.clear();
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const std::size_t at = index(placement_.items[i]);
    const Item& item = items_[at];
    if (item.constraint->follow) followers_.push_back(at);
    if (form == Form::null_space && HeldPoint::describes(*item.constraint, nodes_)) {
      points_.emplace_back(
          i, HeldPoint(*item.constraint, item.first_multiplier, item.measure.front()));
    }
  }
}

void ConstraintBatch::prepare(const State& state, const Stencil& stencil) {
  const double time_mid = (1.0 - stencil.theta) * state.time_prev + stencil.theta * state.time;
  for (const std::size_t at : driven_) {
    Item& item = items_[at];
    item.constraint->drive(time_mid, item.moved_mid);
    item.constraint->drive(state.time, item.moved_next);
  }
}

void ConstraintBatch::follow_signals(const State& state, const Stencil& stencil) {
  for (const std::size_t at : followers_) {
    Item& item = items_[at];
    const Constraint::Follow& follow = *item.constraint->follow;
    const double mid = follow.signal.in_step(state, stencil.theta);
    const double next = follow.signal.in_step(state, 1.0);
    follow.rows(mid, item.moved_mid);
    follow.rows(next, item.moved_next);
    follow.derivative(mid, item.slopes_mid);
    follow.derivative(next, item.slopes_next);
  }
}

Verdict ConstraintBatch::assemble(const State& state, const Stencil& stencil, Want want,
                                  Target& target) {
  follow_signals(state, stencil);
  Verdict verdict = Verdict::ok;
  auto point = points_.begin();
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const bool is_point = point != points_.end() && point->first == i;
    const HeldPoint* held = is_point ? &(point++)->second : nullptr;
    if (want == Want::mass) {
      if (form_ == Form::null_space) assemble_jacobian<NullSpace>(i, state, target);
      if (form_ == Form::multipliers) assemble_jacobian<FullSpace>(i, state, target);
      continue;
    }
    Verdict one;
    if (form_ == Form::multipliers) {
      one = assemble_item<FullSpace>(i, state, stencil, want, target);
    } else if (held != nullptr) {
      one = held->assemble(i, nodes_, placement_, state, stencil, want, target);
    } else {
      one = assemble_item<NullSpace>(i, state, stencil, want, target);
    }
    verdict = worse(verdict, one);
  }
  return verdict;
}

template <class Space>
Verdict ConstraintBatch::assemble_item(std::size_t i, const State& state, const Stencil& stencil,
                                       Want want, Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
  const std::vector<int>& nodes = item.constraint->nodes;
  const int n = static_cast<int>(nodes.size());
  const ItemMotion<max_nodes> motion(nodes_, nodes, state, stencil.theta);
  const double* lambda = state.multipliers.data() + item.first_multiplier;
  const ItemFactors factors_mid = factors_of(item.rows_mid(), motion.mid);
  const ItemFactors factors_next = factors_of(item.rows_next(), motion.next);
  const ItemSlots forces = slot_forces(item.rows_mid(), factors_mid, n, lambda);
  for (int a = 0; a < n; ++a) {
    Vec<W> force;
    const Vec<12> by_slot = forces.middleCols<4>(4 * a).reshaped();
    Space::reduce_rows(by_slot, motion.arms_mid[static_cast<std::size_t>(a)], force);
    if (!std::isfinite(force.sum())) return Verdict::not_finite;
    target.force_scale = std::max(target.force_scale, force.template lpNorm<Eigen::Infinity>());
    placement_.scatter.add_residual(i, a, force.data(), target);
  }
  std::array<double, max_rows> h{};
  for (std::size_t k = 0; k < item.rows_next().size(); ++k) {
    const ConstraintRow& row = item.rows_next()[k];
    h[k] = factors_next[k].value(row);
    if (!std::isfinite(h[k])) return Verdict::not_finite;
    target.constraint_violation =
        std::max(target.constraint_violation, std::abs(h[k]) / item.measure[k]);
    h[k] *= target.multiplier_scale;
  }
  placement_.scatter.add_residual(i, n, h.data(), target);
  if (want == Want::residual) return Verdict::ok;

  add_border<Space>(i, ConstraintJacobian<Space>(item.rows_mid(), factors_mid, n, motion.arms_mid),
                    ConstraintJacobian<Space>(item.rows_next(), factors_next, n, motion.arms_next),
                    target);
  add_curvature<Space>(i, motion, forces, lambda, stencil.theta, target);
  if (item.constraint->follow) add_signal<Space>(i, motion, lambda, stencil.theta, target);
  return Verdict::ok;
}

// The multiplier columns P^T H^T and rows H P, scaled.
template <class Space, class Jacobian>
void ConstraintBatch::add_border(std::size_t i, const Jacobian& columns, const Jacobian& rows,
                                 Target& target) const {
  const int n = columns.nodes();
  for (int a = 0; a < n; ++a) {
    placement_.scatter.add_tangent(i, a, n, target.multiplier_scale * columns.of(a), target);
    placement_.scatter.add_tangent(i, n, a, target.multiplier_scale * rows.of(a).transpose(),
                                   target);
  }
}

// theta sum_k lambda_k A_k between the nodes, and the turning of the projection under the forces
// H^T lambda.
template <class Space, class Motion, class Forces>
void ConstraintBatch::add_curvature(std::size_t i, const Motion& motion, const Forces& forces,
                                    const double* lambda, double theta, Target& target) const {
  constexpr int W = Space::width;
  const std::vector<ConstraintRow>& rows =
      items_[static_cast<std::size_t>(placement_.items[i])].rows_mid();
  const int n = static_cast<int>(forces.cols()) / 4;
  const bool is_curved = !std::ranges::all_of(rows, &ConstraintRow::linear);
  const Scalars A = is_curved ? Scalars(theta * curvature(rows, lambda, 4 * n)) : Scalars();
  for (int a = 0; a < n; ++a) {
    const auto& arms_mid = motion.arms_mid[static_cast<std::size_t>(a)];
    for (int b = 0; b < n; ++b) {
      if (!is_curved && (a != b || Space::form == Form::multipliers)) continue;
      const auto& arms_next = motion.arms_next[static_cast<std::size_t>(b)];
      RowMat<W, W> block = RowMat<W, W>::Zero();
      if (is_curved) {
        Space::add_pairs(A.template block<4, 4>(4 * a, 4 * b), arms_mid, arms_next, block);
      }
      if (a == b) {
        Space::add_turning(forces.template middleCols<4>(4 * a), arms_next, theta, block);
      }
      placement_.scatter.add_tangent(i, a, b, block, target);
    }
  }
}

// How forces and rows change with the signal that is followed.
template <class Space, class Motion>
void ConstraintBatch::add_signal(std::size_t i, const Motion& motion, const double* lambda,
                                 double theta, Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
  const Signal& signal = item.constraint->follow->signal;
  const int n = static_cast<int>(item.constraint->nodes.size());
  const ItemSlots forces =
      slot_forces(item.slopes_mid, factors_of(item.slopes_mid, motion.mid), n, lambda);
  for (int a = 0; a < n; ++a) {
    const Vec<12> by_slot = forces.middleCols<4>(4 * a).reshaped();
    Vec<Space::width> derivative;
    Space::reduce_rows(by_slot, motion.arms_mid[static_cast<std::size_t>(a)], derivative);
    add_signal_column(placement_.scatter, i, a, n + 1, signal, theta, derivative, target);
  }
  const ItemFactors factors = factors_of(item.slopes_next, motion.next);
  Vec<12> derivative = Vec<12>::Zero();
  for (std::size_t k = 0; k < item.slopes_next.size(); ++k) {
    derivative[static_cast<int>(k)] =
        target.multiplier_scale * factors[k].value(item.slopes_next[k]);
  }
  add_signal_column(placement_.scatter, i, n, n + 1, signal, 1.0, derivative, target);
}

// The Jacobian at the end of the step on both sides, as it borders a mass matrix.
template <class Space>
void ConstraintBatch::assemble_jacobian(std::size_t i, const State& state, Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
  const ItemMotion<max_nodes> motion(nodes_, item.constraint->nodes, state, 1.0);
  const ConstraintJacobian<Space> rows(item.rows_next(), factors_of(item.rows_next(), motion.next),
                                       static_cast<int>(item.constraint->nodes.size()),
                                       motion.arms_next);
  add_border<Space>(i, rows, rows, target);
}

StepWork ConstraintBatch::step_work(const State& state, const Stencil& stencil) const {
  StepWork work;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const Item& item = items_[static_cast<std::size_t>(placement_.items[i])];
    if (!placement_.owned[i] || !item.constraint->is_driven()) continue;
    const std::vector<int>& nodes = item.constraint->nodes;
    const ItemMotion<max_nodes> motion(nodes_, nodes, state, stencil.theta);
    ItemSlots moved = motion.next;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      moved.middleCols<4>(4 * static_cast<int>(a)) -= NodeTable::slots(state.prev, nodes[a]);
    }
    const ItemSlots forces = slot_forces(item.rows_mid(), factors_of(item.rows_mid(), motion.mid),
                                         static_cast<int>(nodes.size()),
                                         state.multipliers.data() + item.first_multiplier);
    // the constraint acts with -H^T lambda
    work.drives -= forces.cwiseProduct(moved).sum();
  }
  return work;
}

Vec6 ConstraintBatch::reaction(int node, const State& state, const std::string& constraint) const {
  Vec6 total = Vec6::Zero();
  for (const Item& item : items_) {
    // a rigid connection holds the node that follows, and hands what holds both to its master
    const auto& link = item.constraint->link;
    const bool is_inner = item.constraint->is_structural || (link && link->slave != node);
    const bool counts = constraint.empty() ? !is_inner : item.constraint->name == constraint;
    if (!counts) continue;
    const std::vector<int>& nodes = item.constraint->nodes;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (nodes[a] != node) continue;
      const ItemMotion<max_nodes> motion(nodes_, nodes, state, 1.0);
      const ItemSlots forces = slot_forces(
          item.rows_next(), factors_of(item.rows_next(), motion.next),
          static_cast<int>(nodes.size()), state.multipliers.data() + item.first_multiplier);
      const Vec<12> force = forces.middleCols<4>(4 * static_cast<int>(a)).reshaped();
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
