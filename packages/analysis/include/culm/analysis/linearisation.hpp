/// The equations linearised about a state.
#pragma once

#include <culm/analysis/analysis.hpp>

#include <vector>

namespace culm::analysis {

/// All viscoelastic branches of one relaxation time, or all forces that follow with one delay.
struct LinearBranches {
  double time = 0.0;                                     ///< [s]
  std::shared_ptr<const assembly::Matrix> stiffness;     ///< if their springs follow at once
  std::shared_ptr<const assembly::Matrix> damping = {};  ///< the same by velocities, or null
};

/// Tangent and mass about a state, in the unknowns of the system; rows and columns of constraints
/// border the tangent and are zero in the mass. Those of signals are zero there, too, and in units
/// of their scales.
struct Linearisation {
  std::shared_ptr<const assembly::Matrix> stiffness;
  std::shared_ptr<const assembly::Matrix> mass;
  /// Of dampers, viscous materials and rotating frames, and of what follows signals or has a rate;
  /// null where there is none.
  std::shared_ptr<const assembly::Matrix> damping;
  /// Viscoelastic ones, then delayed forces, by rising times; relaxed where it is linearised.
  std::vector<LinearBranches> branches;
  double asymmetry = 0.0;      ///< of the stiffness, as solver::asymmetry
  bool is_equilibrium = true;  ///< but for rounding
  double residual = 0.0;       ///< largest force residual over the force scale
};

/// Below it a tangent counts as symmetric: what static analyses leave unbalanced is less.
constexpr double largest_asymmetry = 1e-7;

/// About state.next, at the loads of state.time, without inertia, with signals that are free to
/// change; warns where it is no equilibrium.
/// Throws NonFiniteError. Collective.
/// @param stencil  that of statics where signals with a rate stand still
Linearisation linearise(Context& context, const model::State& state,
                        const Stencil& stencil = Stencil::linearisation());

/// What of the damping belongs to the unknowns of signals, without which they have no motion; null
/// where there is none. Collective.
std::shared_ptr<const assembly::Matrix> rates_of_signals(
    const assembly::System& system, const std::shared_ptr<const assembly::Matrix>& damping);

/// Whether damping acts between motions, and not only on what follows signals or has a rate.
/// Collective.
bool damps_motions(const assembly::System& system,
                   const std::shared_ptr<const assembly::Matrix>& damping);

/// Whether forces at state.next depend on velocities. Leaves the system prepared for another step.
/// Collective.
bool feels_rates(assembly::System& system, const model::State& state);

/// Typical squared frequency of the displacement of single nodes, the geometric mean of K_ii / M_ii
/// [1/s^2]: orders of magnitude above the first of a structure.
double typical_eigenvalue(const Linearisation& linear, const assembly::System& system);

}  // namespace culm::analysis
