/// Stress proportional to strain, with the stencil of the step.
#pragma once

#include <culm/mechanics/element.hpp>

namespace culm {

/// Quadratic stored energy W = 1/2 y^T C y at one point, quadrature weight inside C.
/// S = C ((1 - theta_strain) y_prev + theta_strain y_next), so that at theta_strain = 1/2
/// S . (y_next - y_prev) = W_next - W_prev exactly. @source formulation 4.1
template <int M>
struct LinearLaw {
  RowMat<M, M> C = RowMat<M, M>::Zero();  ///< symmetric

  void respond(const Vec<M>& prev, const Vec<M>& next, const Stencil& stencil,
               Response<M>& response) const noexcept {
    const double weight = stencil.theta_strain;
    response.stress.noalias() = C * ((1.0 - weight) * prev + weight * next);
    response.tangent = weight * C;
  }
  double energy(const Vec<M>& y) const noexcept { return 0.5 * y.dot(C * y); }
};

}  // namespace culm
