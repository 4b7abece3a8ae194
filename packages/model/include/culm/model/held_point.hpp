/// Constraints that hold a point, as ball joints do.
#pragma once

#include <culm/model/batch.hpp>
#include <culm/model/constraint.hpp>

#include <array>

namespace culm::model {

/// A constraint at rest that holds a point of one or two nodes that turn,
///   h_k = w_k . P - c_k      P = sum_s alpha_s q_s, the same in each row.
/// What ConstraintBatch does for any constraint is done here with sums once for all rows, and from
/// numbers that stand side by side: chains have one of these for each link, and would wait for rows
/// that are spread over memory.
class HeldPoint {
 public:
  static constexpr int max_nodes = 2;
  static constexpr int max_rows = 3;

  /// Whether a constraint is one.
  static bool describes(const Constraint& constraint, const NodeTable& nodes);

  /// @pre describes(constraint, ...)
  /// @param first_multiplier  in State::multipliers
  /// @param measure           what |h| is judged against: a length [m], or 1
  HeldPoint(const Constraint& constraint, int first_multiplier, double measure);

  /// Adds item `i` of the placement, in the null-space form. @source formulation 4.1, 4.2
  Verdict assemble(std::size_t i, const NodeTable& nodes, const Placement& placement,
                   const State& state, const Stencil& stencil, Want want, Target& target) const;

 private:
  // The share of a node in the point.
  struct Share {
    double of_position = 0.0;  // by which its position counts
    Vec3 arm_mid;              // what its rotation turns of the point
    Vec3 arm_next;
  };

  Share share(int a, const NodeTable& nodes, const State& state, double theta) const;
  Eigen::Map<const Vec<4>> alpha_of(int a) const {
    return Eigen::Map<const Vec<4>>(alpha_.data() + 4 * a);
  }
  template <int Rows>
  void add_tangent(std::size_t i, const Placement& placement, const std::array<Share, 2>& shares,
                   const Vec3& force, double theta, Target& target) const;

  int num_nodes_;
  int num_rows_;
  int first_multiplier_;
  std::array<int, max_nodes> nodes_{};
  std::array<double, 4 * max_nodes> alpha_{};
  Eigen::Matrix<double, 3, max_rows> directions_ = Eigen::Matrix<double, 3, max_rows>::Zero();
  Vec3 constants_ = Vec3::Zero();
  double measure_;
};

}  // namespace culm::model
