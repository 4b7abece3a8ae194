#include <culm/model/model.hpp>
#include <culm/model/steady_rotation.hpp>

#include <algorithm>

namespace culm::model {

std::vector<const SteadyRotation*> rotations_of(const Model& model, std::span<const int> nodes) {
  std::vector<const SteadyRotation*> found;
  for (const auto& load : model.loads()) {
    const auto* rotation = dynamic_cast<const SteadyRotation*>(load.get());
    if (rotation == nullptr) continue;
    const bool turns = std::ranges::any_of(nodes, [&](int node) { return rotation->turns(node); });
    if (turns) found.push_back(rotation);
  }
  return found;
}

}  // namespace culm::model
