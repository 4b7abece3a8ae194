/// Integrals over a linear shell element, from which enhanced parameters are condensed.
#pragma once

#include <culm/material/layup.hpp>
#include <culm/shell/shell_geometry.hpp>

#include <variant>

namespace culm::shell {

/// @pre the material of the layer is linear
inline const Mat6& modulus(const material::Layer& layer) {
  return std::get<material::StVenantKirchhoff>(layer.material.law).C;
}

/// Integrals over an element of products of the strains L y + M α with a modulus between them.
struct ShellIntegrals {
  explicit ShellIntegrals(int parameters)
      : forms(ShellForms::Stiffness::Zero()),
        coupling(Eigen::MatrixXd::Zero(parameters, ShellForms::num_strains)),
        enhanced(Eigen::MatrixXd::Zero(parameters, parameters)) {}

  void add(const ShellGeometry::Point& point, const Mat6& C) {
    const ShellGeometry::StrainMap CL = C * point.strain;
    forms.noalias() += point.strain.transpose() * CL;
    coupling.noalias() += point.enhanced.transpose() * CL;
    enhanced.noalias() += point.enhanced.transpose() * C * point.enhanced;
  }
  /// With parameters that follow the forms, α = P y.
  ShellForms::Stiffness condensed(const Eigen::MatrixXd& P) const {
    ShellForms::Stiffness all = forms;
    all.noalias() += coupling.transpose() * P;
    all.noalias() += P.transpose() * coupling;
    all.noalias() += P.transpose() * enhanced * P;
    return 0.5 * (all + all.transpose());
  }

  ShellForms::Stiffness forms;
  Eigen::MatrixXd coupling, enhanced;
};

}  // namespace culm::shell
