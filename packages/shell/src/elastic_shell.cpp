#include <culm/base/error.hpp>
#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/layer_quadrature.hpp>
#include <culm/shell/shell_mass.hpp>

#include "shell_integrals.hpp"

#include <Eigen/Cholesky>

namespace culm::shell {

// W = min over α of 1/2 int (L y + M α) . C (L y + M α), eq. (1.21)
ElasticShell::ElasticShell(const Nodes& reference, std::shared_ptr<const material::Layup> layup,
                           const ShellOptions& options)
    : ShellForms(reference),
      wall_{ShellGeometry(reference, *layup, options), layup},
      stiffness_(Stiffness::Zero()),
      mass_(shell_mass(wall_.geometry, *layup)) {
  internal_check(layup->is_linear(), "ElasticShell wants a linear layup");
  const int enhanced = options.enhancement.size();
  ShellIntegrals lasting(enhanced);
  const std::vector<double> times = layup->relaxation_times();
  std::vector<ShellIntegrals> branches(times.size(), ShellIntegrals(enhanced));
  visit_volume(
      *layup, 2,
      [&](const material::Layer& layer, double xi, double eta, double zeta, double weight) {
        const ShellGeometry::Point point = wall_.geometry.at(xi, eta, zeta, layer.angle);
        const Mat6 C = weight * point.J * modulus(layer);
        lasting.add(point, C);
        for (std::size_t k = 0; k < times.size(); ++k) {
          const double ratio = layer.material.ratio_of(times[k]);
          if (ratio > 0.0) branches[k].add(point, ratio * C);
        }
      });
  Stiffness stiffness = lasting.forms;
  Eigen::MatrixXd parameters = Eigen::MatrixXd::Zero(enhanced, num_strains);
  if (enhanced > 0) {
    // Cholesky does not mind that thickness modes are far stiffer than others.
    const Eigen::LLT<Eigen::MatrixXd> factor(lasting.enhanced);
    parameters = -factor.solve(lasting.coupling);
    stiffness.noalias() += lasting.coupling.transpose() * parameters;
    if (options.enhancement.thickness > 0) {
      wall_.thickness_parameter = parameters.row(options.enhancement.membrane);
    }
  }
  stiffness_ = Symmetric<num_strains>(0.5 * (stiffness + stiffness.transpose()));
  for (const ShellIntegrals& branch : branches) {
    branches_.emplace_back(branch.condensed(parameters));
  }
}

Verdict ElasticShell::respond(int, const Strain& prev, const Strain& next, const Stencil& stencil,
                              Response<num_strains>& response) const noexcept {
  const double weight = stencil.theta_strain;
  const Strain y = (1.0 - weight) * prev + weight * next;
  const Stiffness C = stiffness_.full();
  response.stress.noalias() = C * y;
  response.tangent = weight * C;
  return Verdict::ok;
}

double ElasticShell::energy(int, const Strain& y) const noexcept {
  Strain stress;
  stress.noalias() = stiffness_.full() * y;
  return 0.5 * y.dot(stress);
}

EnhancedParameters ElasticWall::enhanced_at_centre(const ShellForms::Strain& y) const noexcept {
  const Enhancement& enhancement = geometry.options().enhancement;
  EnhancedParameters parameters = EnhancedParameters::Zero(enhancement.size());
  if (enhancement.thickness > 0) parameters[enhancement.membrane] = thickness_parameter.dot(y);
  return parameters;
}

ShellResultants ElasticWall::resultants(const ShellForms::Strain& y) const noexcept {
  return DeformedShell{geometry, *layup, y, enhanced_at_centre(y)}.resultants();
}

LayerState ElasticWall::layer_state(int layer, double height, const ShellForms::Strain& y) const {
  return DeformedShell{geometry, *layup, y, enhanced_at_centre(y)}.layer_state(layer, height);
}

}  // namespace culm::shell
