#include <culm/flow/fluid_context.hpp>

namespace culm::flow {

Field flow_field() { return text("Flow", "Name of the flow that it stands in."); }

SharedFlow find_flow(const Options& options, FluidContext& context) {
  const std::string& name = options.text("Flow");
  if (const auto found = context.flows.find(name); found != context.flows.end()) {
    return found->second;
  }
  std::vector<std::string> names;
  for (const auto& [known, flow] : context.flows) names.push_back(known);
  context.build.issues.add(options.where("Flow"),
                           "unknown flow '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

}  // namespace culm::flow
