#include <culm/shell/free_strains.hpp>
#include <culm/shell/layer_quadrature.hpp>

#include "shell_integrals.hpp"

#include <Eigen/Cholesky>

namespace culm::shell {

// W is least where K α = h - (int M C L) y, with h = int M C e_0
FreeStrains::FreeStrains(const ElasticWall& wall, const LayerStrain& free)
    : stress(ShellForms::Strain::Zero()) {
  const int enhanced = wall.geometry.options().enhancement.size();
  ShellIntegrals integrals(enhanced);
  EnhancedParameters h = EnhancedParameters::Zero(enhanced);
  visit_volume(
      *wall.layup, 2,
      [&](const material::Layer& layer, double xi, double eta, double zeta, double weight) {
        const ShellGeometry::Point point = wall.geometry.at(xi, eta, zeta, layer.angle);
        const Mat6 C = weight * point.J * modulus(layer);
        const Vec6 e = free(layer, zeta);
        const Vec6 S = C * e;
        integrals.add(point, C);
        stress.noalias() += point.strain.transpose() * S;
        h.noalias() += point.enhanced.transpose() * S;
        energy += 0.5 * e.dot(S);
      });
  EnhancedParameters parameters = EnhancedParameters::Zero(enhanced);
  if (enhanced > 0) {
    parameters = Eigen::LLT<Eigen::MatrixXd>(integrals.enhanced).solve(h);
    stress.noalias() -= integrals.coupling.transpose() * parameters;
    energy -= 0.5 * h.dot(parameters);
  }
  const ShellForms::Strain none = ShellForms::Strain::Zero();
  const DeformedShell shell{wall.geometry, *wall.layup, none, parameters, &free};
  resultants = shell.resultants();
  for (int layer = 0; layer < static_cast<int>(wall.layup->layers.size()); ++layer) {
    for (const double height : {-1.0, 0.0, 1.0}) {
      layer_states.push_back(shell.layer_state(layer, height));
    }
  }
}

}  // namespace culm::shell
