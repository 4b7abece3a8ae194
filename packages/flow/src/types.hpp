/// One function per type of flow, and what types share.
#pragma once

#include <culm/flow/flow.hpp>

namespace culm::flow {

/// Parameter "Density".
inline Field density_field() {
  return number("Density", "kg/m^3", "Mass of the fluid per volume.").positive();
}

void register_uniform(FlowRegistry& registry);
void register_power_law(FlowRegistry& registry);
void register_log_law(FlowRegistry& registry);
void register_table(FlowRegistry& registry);
void register_gust(FlowRegistry& registry);
void register_turbsim_box(FlowRegistry& registry);
void register_mann_box(FlowRegistry& registry);
void register_bladed_box(FlowRegistry& registry);

}  // namespace culm::flow
