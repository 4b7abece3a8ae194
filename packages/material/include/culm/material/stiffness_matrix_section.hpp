/// Section by its full stiffness matrix.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/section.hpp>

namespace culm::material {

/// Any symmetric 6x6 stiffness, as computed by a cross-section tool.
struct StiffnessMatrixSection {
  static Schema schema();
  static Section make(const Options& options);
};

}  // namespace culm::material
