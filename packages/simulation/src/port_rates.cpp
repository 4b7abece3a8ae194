#include "port_rates.hpp"

namespace culm::simulation {

// Ports show rates by the mean velocity, 2 Dq / h - v, which other schemes have as well.
std::vector<std::string> rates_of_another_scheme(const Options& analysis) {
  if (analysis.text("Type") != "Dynamic" || analysis.text("Scheme") != "Generalised Alpha") {
    return {};
  }
  return {
      "ports show velocities and accelerations of steps that are not accepted yet as the scheme "
      "'Conserving' has them; those of 'Generalised Alpha' are others, by up to some percent of "
      "what the step changes; take 'Conserving', or positions and motions"};
}

}  // namespace culm::simulation
