#include "find_sea.hpp"

#include <culm/base/nearest.hpp>

#include <string>
#include <vector>

namespace culm::water {

std::shared_ptr<const Sea> find_sea(const Options& options, flow::FluidContext& context) {
  const flow::SharedFlow found = flow::find_flow(options, context);
  if (found == nullptr) return nullptr;
  auto sea = std::dynamic_pointer_cast<const Sea>(found);
  if (sea != nullptr) return sea;
  std::vector<std::string> names;
  for (const auto& [name, flow] : context.flows) {
    if (std::dynamic_pointer_cast<const Sea>(flow) != nullptr) names.push_back(name);
  }
  const std::string& name = options.text("Flow");
  context.build.issues.add(options.where("Flow"),
                           "'" + name +
                               "' has no surface: it must be a sea, such as 'Still Water'" +
                               did_you_mean(name, names));
  return nullptr;
}

}  // namespace culm::water
