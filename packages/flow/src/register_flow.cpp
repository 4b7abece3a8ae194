#include "types.hpp"

namespace culm::flow {

void register_flows(FlowRegistry& registry) {
  register_uniform(registry);
  register_power_law(registry);
  register_log_law(registry);
  register_table(registry);
  register_gust(registry);
  register_turbsim_box(registry);
  register_mann_box(registry);
  register_bladed_box(registry);
}

}  // namespace culm::flow
