/// A direction that a matrix does not resist, in the user's terms.
#pragma once

#include <culm/analysis/unknown_names.hpp>

namespace culm::analysis {

/// Explains directions in which the equations of a system are singular, or nearly so. All functions
/// are collective; texts are complete on rank 0.
class WeakDirection {
 public:
  WeakDirection(const assembly::System& system, const model::State& state)
      : system_(system), names_(system), q_(state.next) {
    system.complete(q_);
  }

  /// Whether rounding of the matrix is all that resists a motion, however soft the motion and stiff
  /// the rest: a mechanism, or stiffness that is lost beside a much larger one.
  bool is_free(const assembly::Vector& motion) const;
  /// Why the tangent is singular in a direction, and what helps: a mechanism, redundant constraints
  /// or numbers too far apart.
  std::string singular_cause(const assembly::Vector& direction) const;
  /// Which motion in a direction has no inertia, and what helps.
  std::string massless(const assembly::Vector& direction) const;
  /// Where a motion that loses its stiffness is carried by so few nodes, side by side, that the
  /// mesh cannot resolve it: a sentence with the node and the numbers. Empty where it reaches
  /// further.
  std::string local_cause(const assembly::Vector& motion) const;
  /// The largest components of a motion, a line each.
  std::string largest_motions(const assembly::Vector& motion) const;

 private:
  using Motions = std::map<int, Vec6>;  ///< displacement and rotation of the nodes that move

  /// How many nodes carry a motion, (sum m)^2 / sum m^2 of their squared motions m, and the one
  /// that moves most.
  struct Extent {
    double nodes = 0.0;
    int peak = -1;
  };

  Extent extent(const Motions& moved) const;
  bool is_multiplier(const assembly::Vector& vector, std::size_t i) const;
  std::string redundant_constraints(const assembly::Vector& multipliers) const;
  std::string mechanism(const assembly::Vector& motion) const;
  /// Work that a motion takes, over what rounding of the matrix may make of it: below 1 where
  /// nothing resists.
  double resistance(const assembly::Vector& motion) const;
  Motions moved_nodes(const assembly::Vector& motion) const;
  std::string largest_motions(const Motions& moved) const;
  /// How each structure moves that moves as a rigid body, and what holds it.
  std::string rigid_motions(const Motions& moved) const;

  const assembly::System& system_;
  UnknownNames names_;
  model::Coordinates q_;  ///< of all nodes
};

}  // namespace culm::analysis
