/// The stress of a step that does exactly the work it stores.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/stencil.hpp>

namespace culm::material {

/// Stress of a hyperelastic law over a step, and its derivative by the strain at the end: in
/// statics the stress at the end; in dynamics that of the mean strain with a correction along C0 ΔE
/// such that S . ΔE = W(next) - W(prev), C0 being the stiffness at small strains, plus the
/// dissipation (theta_strain - 1/2) C0 ΔE. @source formulation 4.3 to 4.5; Gonzalez (2000)
template <class Law>
Verdict step_stress(const Law& law, const Vec6& prev, const Vec6& next, const Stencil& stencil,
                    Vec6& S, Mat6& tangent) noexcept {
  if (stencil.theta == 1.0) return law.respond(next, S, tangent);
  const Mat6& C0 = law.small_strain_stiffness();
  const Vec6 dE = next - prev;
  const Vec6 direction = C0 * dE;
  const double size = dE.dot(direction);

  Vec6 S_next;
  Mat6 D_next;
  Verdict verdict = law.respond(next, S_next, D_next);
  verdict = worse(verdict, law.respond(0.5 * (prev + next), S, tangent));
  if (verdict != Verdict::ok) return verdict;
  tangent *= 0.5;
  if (size > 1e-8 * C0(0, 0)) {
    const double defect = law.energy(next) - law.energy(prev) - S.dot(dE);
    const double a = defect / size;
    const Vec6 turn = (S_next - S - tangent * dE) / size - (2.0 * a / size) * direction;
    tangent += a * C0 + direction * turn.transpose();
    S += a * direction;
  } else if (size > 0.0) {
    // The defect is of third order and drowns in round-off. Its leading term by the change of the
    // tangent is not, and misses only what is of fifth order.
    Vec6 S_prev;
    Mat6 D_prev;
    verdict = law.respond(prev, S_prev, D_prev);
    const double a = dE.dot((D_next - D_prev) * dE) / (24.0 * size);
    tangent += a * C0;
    S += a * direction;
  }
  const double dissipation = stencil.theta_strain - 0.5;
  S += dissipation * direction;
  tangent += dissipation * C0;
  return verdict;
}

}  // namespace culm::material
