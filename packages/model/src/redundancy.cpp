#include <culm/model/product_sum.hpp>
#include <culm/model/projection.hpp>
#include <culm/model/redundancy.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace culm::model {
namespace {

constexpr double negligible = 1e-8;  // factor of a row of unit length in a combination

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// All rows of all constraints, and the unknowns by which they are judged: six per node, or its
// twelve coordinates where the rows themselves hold its directors.
class RowTable {
 public:
  RowTable(const NodeTable& nodes, const std::vector<Constraint>& equations, Form form)
      : nodes_(nodes), equations_(equations) {
    std::vector<bool> is_replaced(static_cast<std::size_t>(nodes.size()), false);
    for (int e = 0; e < static_cast<int>(equations.size()); ++e) {
      const Constraint& c = equation(e);
      rows_.push_back(c.velocity_rows.empty() ? c.rows : c.velocity_rows);
      if (c.drive && c.velocity_rows.empty()) c.drive(0.0, rows_.back());
      for (int r = 0; r < static_cast<int>(rows_.back().size()); ++r) places_.push_back({e, r});
      if (form == Form::multipliers && c.replaces_internal >= 0) {
        is_replaced[static_cast<std::size_t>(c.replaces_internal)] = true;
      }
    }
    for (bool replaced : is_replaced) {
      first_.push_back(size_);
      width_.push_back(replaced ? 12 : 6);
      size_ += width_.back();
    }
  }

  const std::vector<RedundantSet::Row>& places() const { return places_; }
  const Constraint& equation(int e) const { return equations_[static_cast<std::size_t>(e)]; }

  // h of all rows, each over the length of its gradient
  Eigen::VectorXd values(const Coordinates& q) const {
    Eigen::VectorXd h(static_cast<Eigen::Index>(places_.size()));
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Constraint& c = equation(places_[k].equation);
      // equations on velocities hold in any position
      h[static_cast<Eigen::Index>(k)] =
          c.velocity_rows.empty() ? row_value(row(k), slots_of(c, q)) / scale_[k] : 0.0;
    }
    return h;
  }

  // (H P)^T: one column per row, of unit length unless it is zero. Sets the scales of values().
  Sparse gradients(const Coordinates& q) {
    std::vector<Eigen::Triplet<double>> entries;
    scale_.assign(places_.size(), 1.0);
    Eigen::VectorXd sizes(static_cast<Eigen::Index>(places_.size()));
    for (std::size_t k = 0; k < places_.size(); ++k) {
      sizes[static_cast<Eigen::Index>(k)] = add_gradient(k, q, entries);
    }
    Sparse result(size_, static_cast<int>(places_.size()));
    result.setFromTriplets(entries.begin(), entries.end());
    for (int k = 0; k < result.cols(); ++k) {
      const double length = result.col(k).norm();
      // between nodes that are held nothing but round-off is left of a row
      if (length <= 1e-12 * sizes[k]) {
        result.col(k) *= 0.0;
        continue;
      }
      result.col(k) /= length;
      scale_[static_cast<std::size_t>(k)] = length;
    }
    return result;
  }

  // By how much the prescribed motion of a row has changed h since time zero.
  double motion(std::size_t k, double time, const Coordinates& q) const {
    const Constraint& c = equation(places_[k].equation);
    if (!c.drive) return 0.0;
    std::vector<ConstraintRow> rows = c.rows;
    c.drive(time, rows);
    const Eigen::Matrix3Xd slots = slots_of(c, q);
    const ConstraintRow& moved = rows[static_cast<std::size_t>(places_[k].row)];
    return (row_value(moved, slots) - row_value(row(k), slots)) / scale_[k];
  }

  // Where the unknowns of each node begin.
  const std::vector<int>& first_unknowns() const { return first_; }

  void move(const Eigen::VectorXd& u, Coordinates& q) const {
    for (int node = 0; node < nodes_.size(); ++node) {
      if (nodes_.is_slave(node)) continue;
      const auto at = static_cast<std::size_t>(node);
      if (width_[at] == 12) {
        NodeTable::slots(q, node).reshaped() += u.segment<12>(first_[at]);
      } else {
        nodes_.move(node, u.segment<6>(first_[at]), q);
      }
    }
    for (int node = 0; node < nodes_.size(); ++node) {
      if (nodes_.is_slave(node)) nodes_.follow_master(node, q);
    }
  }

  // Rotations of a few degrees without any symmetry, where nothing is fixed.
  Eigen::VectorXd perturbation() const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(size_);
    for (int node = 0; node < nodes_.size(); ++node) {
      const auto at = static_cast<std::size_t>(node);
      if (width_[at] == 12 || nodes_.is_slave(node)) continue;
      if (nodes_.kind(node) != NodeKind::node12) continue;
      for (int i = 3; i < 6; ++i) {
        if (nodes_.fixed(node)[static_cast<std::size_t>(i)]) continue;
        u[first_[at] + i] = 0.2 * (std::fmod(0.6180339887498949 * (6 * node + i + 1), 1.0) - 0.5);
      }
    }
    return u;
  }

 private:
  const ConstraintRow& row(std::size_t k) const {
    return rows_[static_cast<std::size_t>(places_[k].equation)]
                [static_cast<std::size_t>(places_[k].row)];
  }

  // Returns the size of the numbers that the entries are differences of.
  double add_gradient(std::size_t k, const Coordinates& q,
                      std::vector<Eigen::Triplet<double>>& entries) const {
    double size = 0.0;
    const Constraint& c = equation(places_[k].equation);
    const ConstraintRow& row = this->row(k);
    const Eigen::Matrix3Xd slots = slots_of(c, q);
    const Eigen::Matrix3Xd gradients = row_gradient(row, slots);
    for (std::size_t a = 0; a < c.nodes.size(); ++a) {
      const Vec<12> gradient = gradients.middleCols<4>(4 * static_cast<int>(a)).reshaped();
      const Arms<4> arms = arms_of(nodes_, c.nodes[a], q);
      size += gradient.norm() * std::max(1.0, arms.slots.norm());
      const int master = nodes_.master(c.nodes[a]);
      const auto at = static_cast<std::size_t>(master);
      const int column = static_cast<int>(k);
      if (width_[at] == 12) {
        for (int i = 0; i < 12; ++i) entries.emplace_back(first_[at] + i, column, gradient[i]);
        continue;
      }
      Vec6 reduced;
      NullSpace::reduce_rows(gradient, arms, reduced);
      for (int i = 0; i < 6; ++i) {
        if (nodes_.fixed(master)[static_cast<std::size_t>(i)]) continue;
        if (reduced[i] != 0.0) entries.emplace_back(first_[at] + i, column, reduced[i]);
      }
    }
    return size;
  }

  const NodeTable& nodes_;
  const std::vector<Constraint>& equations_;
  std::vector<std::vector<ConstraintRow>> rows_;  // by constraint, as they are at time zero
  std::vector<RedundantSet::Row> places_;
  std::vector<int> first_, width_;  // unknowns of each node
  int size_ = 0;
  std::vector<double> scale_;
};

// Rank-revealing factors G P = Q R of some gradients.
class Factors {
 public:
  Factors(const Sparse& gradients, const std::vector<int>& columns) : columns_(columns) {
    // Eigen writes beyond the memory of factors without rows or columns
    if (gradients.rows() == 0 || columns.empty()) return;
    Sparse some(gradients.rows(), static_cast<int>(columns.size()));
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < some.cols(); ++k) {
      for (Sparse::InnerIterator it(gradients, columns[static_cast<std::size_t>(k)]); it; ++it) {
        entries.emplace_back(static_cast<int>(it.row()), k, it.value());
      }
    }
    some.setFromTriplets(entries.begin(), entries.end());
    qr_.setPivotThreshold(1e-10);
    qr_.compute(some);
    rank_ = static_cast<int>(qr_.rank());
    // Eigen leaves the entries of R unsorted, which neither blocks nor triangular solves expect; a
    // copy by rows sorts them
    R_ = Eigen::SparseMatrix<double, Eigen::RowMajor, int>(qr_.matrixR());
    independent_ = R_.topLeftCorner(rank_, rank_);
    for (int place = 0; place < cols(); ++place) {
      const int k = qr_.colsPermutation().indices()[place];
      columns_[static_cast<std::size_t>(place)] = columns[static_cast<std::size_t>(k)];
    }
  }

  int rank() const { return rank_; }
  int cols() const { return static_cast<int>(columns_.size()); }
  // Number of the gradient at a place; those from the rank on depend on the ones before.
  int column(int place) const { return columns_[static_cast<std::size_t>(place)]; }

  // A dependent column as a combination of the independent ones, by place.
  Eigen::VectorXd combination(int place) const {
    if (rank_ == 0) return {};
    Eigen::VectorXd x = Eigen::VectorXd(R_.col(place)).head(rank_);
    independent_.triangularView<Eigen::Upper>().solveInPlace(x);
    return x;
  }

  // The smallest u with G^T u = b in the independent columns.
  Eigen::VectorXd smallest_solution(const Eigen::VectorXd& b) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(qr_.rows());
    if (rank_ == 0) return y;
    for (int place = 0; place < rank_; ++place) y[place] = b[column(place)];
    Eigen::VectorXd head = y.head(rank_);
    independent_.transpose().triangularView<Eigen::Lower>().solveInPlace(head);
    y.head(rank_) = head;
    return qr_.matrixQ() * y;
  }

  // How far a gradient is from what the independent ones span.
  double distance(const Sparse& gradients, int column) const {
    if (rank_ == 0) return gradients.col(column).norm();
    const Eigen::VectorXd parts =
        qr_.matrixQ().transpose() * Eigen::VectorXd(gradients.col(column));
    return parts.tail(parts.size() - rank_).norm();
  }

 private:
  int rank_ = 0;
  std::vector<int> columns_;  // by place
  Eigen::SparseQR<Sparse, Eigen::COLAMDOrdering<int>> qr_;
  Sparse R_;            // with sorted entries
  Sparse independent_;  // the square part of R
};

// The gradients that may take part in a dependence. If those that touch a node are independent in
// the unknowns of that node alone, each has the factor zero in every combination that vanishes;
// without them the same may be true of the next node. An open chain is unravelled from its end,
// and only what closes loops is left.
class Unraveller {
 public:
  Unraveller(const Sparse& gradients, const std::vector<int>& first_unknowns)
      : gradients_(gradients), first_(first_unknowns) {
    node_of_.resize(static_cast<std::size_t>(gradients.rows()));
    for (std::size_t node = 0; node < first_.size(); ++node) {
      const int end =
          node + 1 < first_.size() ? first_[node + 1] : static_cast<int>(gradients.rows());
      for (int i = first_[node]; i < end; ++i) node_of_[static_cast<std::size_t>(i)] = node;
    }
    columns_of_.resize(first_.size());
    for (int column = 0; column < gradients.cols(); ++column) {
      for (std::size_t node : nodes_of(column)) columns_of_[node].push_back(column);
    }
    is_left_.assign(static_cast<std::size_t>(gradients.cols()), true);
  }

  std::vector<int> possibly_dependent() {
    std::vector<std::size_t> waiting(first_.size());
    std::iota(waiting.begin(), waiting.end(), std::size_t{0});
    while (!waiting.empty()) {
      const std::size_t node = waiting.back();
      waiting.pop_back();
      std::vector<int>& columns = columns_of_[node];
      std::erase_if(columns, [&](int c) { return !is_left_[static_cast<std::size_t>(c)]; });
      if (columns.empty() || !are_independent(columns, node)) continue;
      for (int column : columns) {
        is_left_[static_cast<std::size_t>(column)] = false;
        for (std::size_t other : nodes_of(column)) {
          if (other != node) waiting.push_back(other);
        }
      }
    }
    std::vector<int> left;
    for (int column = 0; column < gradients_.cols(); ++column) {
      if (is_left_[static_cast<std::size_t>(column)]) left.push_back(column);
    }
    return left;
  }

 private:
  static constexpr int max_width = 12;

  std::vector<std::size_t> nodes_of(int column) const {
    std::vector<std::size_t> nodes;
    for (Sparse::InnerIterator it(gradients_, column); it; ++it) {
      if (it.value() == 0.0) continue;
      nodes.push_back(node_of_[static_cast<std::size_t>(it.row())]);
    }
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  // Beyond doubt: what is hardly so stays for the factors.
  bool are_independent(const std::vector<int>& columns, std::size_t node) const {
    if (columns.size() > max_width) return false;
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero(max_width, static_cast<int>(columns.size()));
    for (int k = 0; k < part.cols(); ++k) {
      for (Sparse::InnerIterator it(gradients_, columns[static_cast<std::size_t>(k)]); it; ++it) {
        if (node_of_[static_cast<std::size_t>(it.row())] != node) continue;
        part(static_cast<int>(it.row()) - first_[node], k) = it.value();
      }
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(part);
    // against the unit length of a gradient, not against what is left of it here
    return std::abs(qr.matrixR()(part.cols() - 1, part.cols() - 1)) > 1e-3;
  }

  const Sparse& gradients_;
  const std::vector<int>& first_;
  std::vector<std::size_t> node_of_;          // by unknown
  std::vector<std::vector<int>> columns_of_;  // by node
  std::vector<bool> is_left_;                 // by column
};

// The motion that closes all rows to first order, by the method of Levenberg and Marquardt with a
// weight that falls with the square of the error: rows may depend on each other. It converges
// quadratically to where they always do.
// @source N. Yamashita, M. Fukushima, Computing Suppl. 15, 239 (2001)
Eigen::VectorXd damped_step(const Sparse& gradients, const Eigen::VectorXd& h) {
  constexpr double least_weight = 1e-12;
  Sparse products = gradients.transpose() * gradients;
  const double weight = std::max(h.squaredNorm(), least_weight);
  for (int k = 0; k < products.cols(); ++k) products.coeffRef(k, k) += weight;
  const Eigen::SimplicialLDLT<Sparse> factors(products);
  return -(gradients * factors.solve(h));
}

// The smallest motion that closes the rows that are independent.
Eigen::VectorXd smallest_step(const Sparse& gradients, const Eigen::VectorXd& h) {
  std::vector<int> columns(static_cast<std::size_t>(gradients.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  return Factors(gradients, columns).smallest_solution(-h);
}

// A configuration near q where all rows hold; nothing if none is found. Where the iteration is
// slow, a motion that is held to second order alone has been left at the root of what is small.
template <class Step>
std::optional<Coordinates> admissible(RowTable& table, Coordinates q, Step step) {
  constexpr double slow = 1e-2;
  double before = HUGE_VAL;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Sparse gradients = table.gradients(q);
    const Eigen::VectorXd h = table.values(q);
    const double error = h.lpNorm<Eigen::Infinity>();
    if (error < 1e-12 && error > slow * before) return {};
    if (error < 1e-12) return q;
    before = error;
    const Eigen::VectorXd u = step(gradients, h);
    if (!u.allFinite()) return {};
    table.move(u, q);
  }
  return {};
}

// Damped steps are cheap; near positions that are singular the others may get further.
std::optional<Coordinates> admissible(RowTable& table, const Coordinates& q) {
  auto found = admissible(table, q, damped_step);
  return found ? found : admissible(table, q, smallest_step);
}

// Whether the dependent row at a place and the combination x that implies it are driven alike.
bool is_consistent(const RowTable& table, const Factors& factors, int place,
                   const Eigen::VectorXd& x, const Coordinates& q) {
  for (double time : {0.013, 0.11, 0.37, 1.0, 3.1, 17.0}) {
    const auto motion = [&](int at) {
      return table.motion(static_cast<std::size_t>(factors.column(at)), time, q);
    };
    double difference = -motion(place);
    double size = std::abs(difference);
    for (int at = 0; at < x.size(); ++at) {
      if (std::abs(x[at]) <= negligible) continue;
      difference += x[at] * motion(at);
      size = std::max(size, std::abs(x[at] * motion(at)));
    }
    if (std::abs(difference) > 1e-9 * size) return false;
  }
  return true;
}

// The dependent rows with all rows that imply them, joined where they share a constraint.
std::vector<RedundantSet> dependent_sets(const RowTable& table, const Factors& factors,
                                         const Coordinates& q) {
  std::vector<RedundantSet> sets;
  for (int place = factors.rank(); place < factors.cols(); ++place) {
    const auto row_of = [&](int at) {
      return table.places()[static_cast<std::size_t>(factors.column(at))];
    };
    RedundantSet set;
    set.dependent = {row_of(place)};
    set.members = {row_of(place).equation};
    const Eigen::VectorXd x = factors.combination(place);
    for (int at = 0; at < x.size(); ++at) {
      if (std::abs(x[at]) > negligible) set.members.push_back(row_of(at).equation);
    }
    const bool of_velocity = std::ranges::any_of(
        set.members, [&](int e) { return !table.equation(e).velocity_rows.empty(); });
    if (of_velocity || !is_consistent(table, factors, place, x, q)) {
      set.kind = RedundantSet::Kind::contradictory;
    }
    const auto shares = [&](const RedundantSet& other) {
      return std::ranges::find_first_of(set.members, other.members) != set.members.end();
    };
    for (auto other = sets.begin(); other != sets.end();) {
      if (!shares(*other)) {
        ++other;
        continue;
      }
      set.members.insert(set.members.end(), other->members.begin(), other->members.end());
      set.dependent.insert(set.dependent.end(), other->dependent.begin(), other->dependent.end());
      if (other->kind == RedundantSet::Kind::contradictory) set.kind = other->kind;
      other = sets.erase(other);
    }
    std::ranges::sort(set.members);
    set.members.erase(std::unique(set.members.begin(), set.members.end()), set.members.end());
    sets.push_back(std::move(set));
  }
  std::ranges::sort(sets, {}, [](const RedundantSet& set) { return set.members.front(); });
  return sets;
}

std::vector<int> independent_columns(const Factors& factors) {
  std::vector<int> columns;
  for (int place = 0; place < factors.rank(); ++place) columns.push_back(factors.column(place));
  return columns;
}

// Whether rows of a set leave the span of those that were independent at the start.
bool gains_rank(const RowTable& table, const Sparse& gradients, const Factors& independent,
                const Factors& reference, const RedundantSet& set) {
  constexpr double least = 1e-6;  // of the length of a gradient
  for (int place = reference.rank(); place < reference.cols(); ++place) {
    const int column = reference.column(place);
    const RedundantSet::Row row = table.places()[static_cast<std::size_t>(column)];
    const bool belongs = std::ranges::any_of(set.dependent, [&](const RedundantSet::Row& one) {
      return one.equation == row.equation && one.row == row.row;
    });
    if (belongs && independent.distance(gradients, column) > least) return true;
  }
  return false;
}

// Where rows depend on each other only at the start, they do so nowhere else; what rounding makes
// of rows that always do is not the same everywhere. A position nearby where the rows that are
// independent at the start are not so is singular by itself and tells nothing; and if none is
// found, there is none, or it is out of reach.
void find_sets_of_position(RowTable& table, const Factors& reference, const Coordinates& start,
                           std::vector<RedundantSet>& sets) {
  const std::vector<int> columns = independent_columns(reference);
  std::vector<bool> gains(sets.size(), true);
  bool found = false;
  for (double size : {1.0, -0.5, 0.25}) {
    Coordinates moved = start;
    table.move(size * table.perturbation(), moved);
    const auto nearby = admissible(table, moved);
    if (!nearby) continue;
    const Sparse gradients = table.gradients(*nearby);
    const Factors independent(gradients, columns);
    if (independent.rank() != reference.rank()) continue;
    found = true;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      gains[k] = gains[k] && gains_rank(table, gradients, independent, reference, sets[k]);
    }
  }
  for (std::size_t k = 0; k < sets.size(); ++k) {
    if (found && gains[k] && sets[k].kind == RedundantSet::Kind::structural) {
      sets[k].kind = RedundantSet::Kind::position;
    }
  }
}

}  // namespace

std::vector<RedundantSet> find_redundant_rows(const NodeTable& nodes,
                                              const std::vector<Constraint>& equations, Form form,
                                              const Coordinates& start) {
  RowTable table(nodes, equations, form);
  if (table.places().empty()) return {};
  const Coordinates q = admissible(table, start).value_or(start);
  const Sparse at_start = table.gradients(q);
  const std::vector<int> doubtful =
      Unraveller(at_start, table.first_unknowns()).possibly_dependent();
  if (doubtful.empty()) return {};
  const Factors factors(at_start, doubtful);
  if (factors.rank() == factors.cols()) return {};
  std::vector<RedundantSet> sets = dependent_sets(table, factors, q);
  find_sets_of_position(table, factors, q, sets);
  return sets;
}

}  // namespace culm::model
