/// One function per type of flow, and what types share.
#pragma once

#include <culm/flow/flow.hpp>

namespace culm::flow {

/// Parameter "Density".
inline Field density_field() {
  return number("Density", "kg/m^3", "Mass of the fluid per volume.").positive();
}

/// Every type, one line each: NAME stands for register_NAME.
#define CULM_FLOWS(TYPE) \
  TYPE(uniform)          \
  TYPE(power_law)        \
  TYPE(log_law)          \
  TYPE(table)            \
  TYPE(gust)             \
  TYPE(turbsim_box)      \
  TYPE(mann_box)         \
  TYPE(bladed_box)

#define CULM_DECLARE(type) void register_##type(FlowRegistry& registry);
CULM_FLOWS(CULM_DECLARE)
#undef CULM_DECLARE

}  // namespace culm::flow
