/// Kinematic constraints as rows of quadratic forms.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/math/types.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/own_unknowns.hpp>

#include <bitset>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace culm::model {

/// A combination of slots of the nodes of a constraint, sum_s factor_s q_s; four factors per node.
using SlotSum = std::vector<double>;

/// One equation h(q) = 0 of the slots,
///   h = P . Q - c      P = sum_s alpha_s q_s      Q = w + sum_s beta_s q_s
/// Without beta the row is linear. Sums of products: product_sum.hpp. @source formulation 2.1
struct ConstraintRow {
  SlotSum alpha;
  SlotSum beta;                   ///< empty in linear rows
  Vec3 direction = Vec3::Zero();  ///< w
  double constant = 0.0;          ///< c

  bool linear() const { return beta.empty(); }
};

/// w . P - c, with c such that h = 0 at `q`, the slots of the nodes side by side, shape (3, 4 n).
ConstraintRow linear_row(const Vec3& direction, SlotSum alpha, const Eigen::Matrix3Xd& q);
/// P . (Q - origin) - c, with c such that h = 0 at `q`.
ConstraintRow product_row(SlotSum alpha, SlotSum beta, const Eigen::Matrix3Xd& q,
                          const Vec3& origin = Vec3::Zero());

/// Position of a point fixed to node `a` of `n` nodes at `offset` in its directors.
SlotSum attached_point(int a, int n, const Vec3& offset);
/// Vector fixed to node `a` of `n` nodes with components `nu` in its directors.
SlotSum attached_vector(int a, int n, const Vec3& nu);

/// A support, link or joint. The rows are always there; where the null-space form can remove
/// unknowns instead, `fix` or `link` says how and the rows are not assembled.
struct Constraint {
  std::string name;
  std::string type;
  Where where;  ///< in the deck; empty for what culm adds itself
  std::vector<int> nodes;
  std::vector<ConstraintRow> rows;
  /// Rows with the gradients of equations on velocities, which a batch with unknowns of its own
  /// writes; `rows` is then of the same size and not looked at.
  std::vector<ConstraintRow> velocity_rows;

  struct Fix {
    int node = -1;
    std::bitset<6> unknowns;  ///< translations 0-2, rotations 3-5
  };
  struct Link {
    int slave = -1;
    int master = -1;
  };
  std::optional<Fix> fix;
  std::optional<Link> link;
  /// Node whose internal constraints the rows imply, -1 if none (formulation 2.8).
  int replaces_internal = -1;
  /// Acts between nodes only, hence keeps the momenta of the model.
  bool is_internal = false;
  /// Part of the mechanics of a structure, such as an axis that does not stretch: its forces are
  /// stresses, no reactions.
  bool is_structural = false;
  /// Moves the rows in time (inhomogeneous constraints); empty for fixed ones.
  std::function<void(double time, std::vector<ConstraintRow>& rows)> drive;
  /// Moves them with a signal instead, which must have a rate: rows and their derivative by a value
  /// of the signal, alpha, direction and constant.
  struct Follow {
    Signal signal;
    std::function<void(double value, std::vector<ConstraintRow>& rows)> rows;
    std::function<void(double value, std::vector<ConstraintRow>& rows)> derivative;
  };
  std::optional<Follow> follow;
  /// A turn that is prescribed. The rows hold half a turn away as well, and no state counts turns,
  /// so steps look at it: turns.hpp of package analysis.
  struct Turn {
    /// From the reference, at (1 - theta) prev + theta next of a step [rad].
    std::function<double(const State& state, double theta)> prescribed;
    /// How far the slots of the nodes, side by side, are from a turn by an angle: up to full turns,
    /// in [0, pi], and zero where they do not tell; empty where the rows hold nowhere else.
    std::function<double(double angle, const Eigen::Matrix3Xd& q)> off;
  };
  std::optional<Turn> turn;
  /// Whether the rows move.
  bool is_driven() const { return drive || follow; }
};

/// h of a row for the slots of the nodes side by side, shape (3, 4 n).
double row_value(const ConstraintRow& row, const Eigen::Matrix3Xd& q);
/// The slots of the nodes of a constraint side by side, shape (3, 4 n).
Eigen::Matrix3Xd slots_of(const Constraint& constraint, const Coordinates& q);

/// sum_s factor_s q_s.
Vec3 vector_of(const SlotSum& sum, const Eigen::Matrix3Xd& q);

/// d_i . d_j = delta_ij of one node: six product rows. @source formulation 2.2 "internal"
Constraint internal_constraint(const NodeTable& nodes, int node);

}  // namespace culm::model
