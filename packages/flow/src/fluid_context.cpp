#include <culm/flow/fluid_context.hpp>
#include <culm/model/steady_rotation.hpp>

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

void refuse_rotating_frame(const Options& options, const std::vector<int>& nodes,
                           FluidContext& context) {
  context.after_all_loads([&options, nodes, &context] {
    if (model::rotations_of(context.build.model, nodes).empty()) return;
    context.build.issues.add(
        options.where(),
        "stands on what a load 'Rotating Frame' turns, whose speed it does not see: name only what "
        "it does not stand on in 'Structures' of the frame, or take a motion in time without it");
  });
}

}  // namespace culm::flow
