/// Section by its stiffness values.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/section.hpp>

namespace culm::material {

/// The eleven values of eq. (1.9) and the six of eq. (1.10).
struct StiffnessValuesSection {
  static Schema schema();
  static Section make(const Options& options);
};

/// The six mass values of eq. (1.10); for all types that do not know a density.
Schema mass_values_schema();
/// Their rule: the mass matrix is positive semidefinite.
void check_mass_values(const Options& options, InputIssues& issues);
MassValues read_mass_values(const Options& options);

}  // namespace culm::material
