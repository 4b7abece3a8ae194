#include <culm/shell/layer_quadrature.hpp>
#include <culm/shell/shell_mass.hpp>

namespace culm::shell {

// Per direction of the plane the integrand has degree 4 (shape functions 2, volume 2), and 4
// through the thickness: three points.
SlotMatrix<ShellForms::num_slots> shell_mass(const ShellGeometry& geometry,
                                             const material::Layup& layup) {
  SlotMatrix<ShellForms::num_slots> M = SlotMatrix<ShellForms::num_slots>::Zero();
  visit_volume(
      layup, 3,
      [&](const material::Layer& layer, double xi, double eta, double zeta, double weight) {
        const Vec<4> N = shape_functions(xi, eta);
        Vec<ShellForms::num_slots> T;  // velocity of the point = sum over slots of T_s q_s
        for (int a = 0; a < 4; ++a) T.segment<2>(2 * a) << N[a], N[a] * zeta;
        const double mass = weight * geometry.jacobian(xi, eta, zeta) * layer.material.density;
        M += mass * T * T.transpose();
      });
  return M;
}

}  // namespace culm::shell
