/// One function per type of flow, and what types share.
#pragma once

#include <culm/flow/flow.hpp>

namespace culm::flow {

/// Parameter "Density".
inline Field density_field() {
  return number("Density", "kg/m^3", "Mass of the fluid per volume.").positive();
}

void register_uniform(FlowRegistry& registry);

}  // namespace culm::flow
