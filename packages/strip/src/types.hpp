/// One function per type of airfoil, and per type of load beside Strip.
#pragma once

#include <culm/strip/airfoil.hpp>
#include <culm/strip/register_strip.hpp>

namespace culm::strip {

/// Every type, one line each: NAME stands for register_NAME.
#define CULM_AIRFOILS(TYPE) \
  TYPE(thin)                \
  TYPE(polar)

#define CULM_DECLARE(type) void register_##type(AirfoilRegistry& registry);
CULM_AIRFOILS(CULM_DECLARE)
#undef CULM_DECLARE

void register_strip_drag(StripRegistry& registry);

}  // namespace culm::strip
