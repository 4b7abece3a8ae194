#include "lost_moments.hpp"

#include <culm/load/moment_load.hpp>

#include <fmt/format.h>

namespace culm::simulation {

std::vector<std::string> moments_that_are_not_carried(const model::Model& model) {
  constexpr double notable = 0.01;
  std::vector<std::string> sentences;
  for (const auto& load : model.loads()) {
    const auto* moments = dynamic_cast<const load::MomentLoad*>(load.get());
    if (moments == nullptr) continue;
    const load::MomentLoad::Lost lost = moments->lost();
    if (lost.share < notable) continue;
    sentences.push_back(fmt::format(
        "{} is not carried as a whole: {:.2g} % of it at '{}' turn about the director of the "
        "shell, which resists no such moment; take forces at several nodes, or a body or beam "
        "that is connected to them",
        load->effect().quoted(), 100.0 * lost.share, model.node_name(lost.node)));
  }
  return sentences;
}

}  // namespace culm::simulation
