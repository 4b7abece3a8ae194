/// One function per type of airfoil.
#pragma once

#include <culm/strip/airfoil.hpp>

namespace culm::strip {

/// Every type, one line each: NAME stands for register_NAME.
#define CULM_AIRFOILS(TYPE) \
  TYPE(thin)                \
  TYPE(polar)

#define CULM_DECLARE(type) void register_##type(AirfoilRegistry& registry);
CULM_AIRFOILS(CULM_DECLARE)
#undef CULM_DECLARE

}  // namespace culm::strip
