/// How much solids grow as they get warmer.
#pragma once

#include <culm/base/schema.hpp>

namespace culm::material {

/// Parameter "Expansion" of what grows alike in all directions.
inline Field expansion_field() {
  return number("Expansion", "1/K", "Coefficient of thermal expansion, for heat.").optional(0.0);
}

}  // namespace culm::material
