/// Inertia of the four-node shell.
#pragma once

#include <culm/material/layup.hpp>
#include <culm/shell/shell_geometry.hpp>

namespace culm::shell {

/// Consistent mass between slots, exact: int rho N_a N_b ζ^(r+s) dV with r, s = 0 for positions and
/// 1 for directors [kg, kg m, kg m^2]. @source formulation 1.4, (1.22)
SlotMatrix<ShellForms::num_slots> shell_mass(const ShellGeometry& geometry,
                                             const material::Layup& layup);

}  // namespace culm::shell
