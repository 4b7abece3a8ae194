#include <culm/base/error.hpp>
#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/layer_quadrature.hpp>
#include <culm/shell/shell_mass.hpp>

#include <Eigen/Cholesky>

#include <utility>
#include <variant>

namespace culm::shell {

namespace {

const Mat6& modulus(const material::Layer& layer) {
  return std::get<material::StVenantKirchhoff>(layer.material.law).C;
}

}  // namespace

// W = min over α of 1/2 int (L y + M α) . C (L y + M α), eq. (1.21)
ElasticShell::ElasticShell(const Nodes& reference, std::shared_ptr<const material::Layup> layup,
                           const ShellOptions& options)
    : ShellForms(reference),
      wall_{ShellGeometry(reference, *layup, options), layup},
      stiffness_(Stiffness::Zero()),
      mass_(shell_mass(wall_.geometry, *layup)) {
  internal_check(layup->is_linear(), "ElasticShell wants a linear layup");
  const int enhanced = options.enhancement.size();
  Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(enhanced, num_strains);
  Eigen::MatrixXd enhanced_stiffness = Eigen::MatrixXd::Zero(enhanced, enhanced);
  visit_volume(
      *layup, 2,
      [&](const material::Layer& layer, double xi, double eta, double zeta, double weight) {
        const ShellGeometry::Point point = wall_.geometry.at(xi, eta, zeta, layer.angle);
        const Mat6 C = weight * point.J * modulus(layer);
        const ShellGeometry::StrainMap CL = C * point.strain;
        stiffness_.noalias() += point.strain.transpose() * CL;
        coupling.noalias() += point.enhanced.transpose() * CL;
        enhanced_stiffness.noalias() += point.enhanced.transpose() * C * point.enhanced;
      });
  if (enhanced > 0) {
    // Cholesky does not mind that thickness modes are far stiffer than others.
    const Eigen::LLT<Eigen::MatrixXd> factor(enhanced_stiffness);
    const Eigen::MatrixXd parameters = -factor.solve(coupling);
    stiffness_.noalias() += coupling.transpose() * parameters;
    if (options.enhancement.thickness > 0) {
      wall_.thickness_parameter = parameters.row(options.enhancement.membrane);
    }
  }
  stiffness_ = 0.5 * (stiffness_ + stiffness_.transpose()).eval();
}

Verdict ElasticShell::respond(int, const Strain& prev, const Strain& next, const Stencil& stencil,
                              Response<num_strains>& response) const noexcept {
  const double weight = stencil.theta_strain;
  const Strain y = (1.0 - weight) * prev + weight * next;
  response.stress.noalias() = stiffness_ * y;
  response.tangent = weight * stiffness_;
  return Verdict::ok;
}

double ElasticShell::energy(int, const Strain& y) const noexcept {
  Strain stress;
  stress.noalias() = stiffness_ * y;
  return 0.5 * y.dot(stress);
}

const ShellForms::Stiffness& ElasticShell::stiffness(int) const noexcept { return stiffness_; }

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
