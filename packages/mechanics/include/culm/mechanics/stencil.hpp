/// Where in a step forces and stresses are taken.
#pragma once

namespace culm {

/// With q_theta = (1 - theta) q_prev + theta q_next, every element and load evaluates
///   force    B(q_theta)^T S        S from (1 - theta_strain) e(q_prev) + theta_strain e(q_next)
///   tangent  theta K_geo(S) + theta_strain B(q_theta)^T C B(q_next)
/// theta = theta_strain = 1 is statics, 1/2 and 1/2 the energy-conserving step.
/// @source formulation 4.1, 4.5
struct Stencil {
  double step = 0.0;          ///< time step [s]; 0 in statics
  double theta = 1.0;         ///< point of the step where forces act [-]
  double theta_strain = 1.0;  ///< weight of the new strain in the stress [-]
  /// Derivative of the acceleration in the equations by q_next [1/s^2]; 0: no inertia.
  double inertia = 0.0;
  /// Without a step: unknowns that have a rate obey their equations but for it, for linearisations,
  /// instead of standing still.
  bool frees_states = false;

  static constexpr Stencil statics() { return {}; }
  /// Statics, about which all that moves in time is linearised.
  static constexpr Stencil linearisation() { return {0.0, 1.0, 1.0, 0.0, true}; }
  /// Dq = step (v_prev + v_next) / 2, hence Dv / step = 2 Dq / step^2 - 2 v_prev / step.
  static constexpr Stencil midpoint(double step) { return {step, 0.5, 0.5, 2.0 / (step * step)}; }
};

/// What an assembly pass is asked for.
enum class Want {
  residual,
  residual_and_tangent,
  mass,  ///< mass matrix and constraint Jacobians at q_next, in place of the tangent
};

/// The outcome of an evaluation, the same type for kernels and for whole systems. Ordered: the
/// larger value wins when outcomes of items or ranks are joined.
enum class Verdict {
  ok = 0,
  law_out_of_range,  ///< a material law or strain measure left its domain
  inverted_element,  ///< a negative volume or a relative rotation beyond the element's range
  not_finite,        ///< NaN or infinity in a force
};

constexpr Verdict worse(Verdict a, Verdict b) { return a < b ? b : a; }

}  // namespace culm
