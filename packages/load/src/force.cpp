#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "types.hpp"

namespace culm::load {
namespace {

std::unique_ptr<model::Batch> make_force(const LoadRequest& request) {
  auto load = std::make_unique<SlotLoad>(request.effect, request.nodes(), request.function);
  const auto nodes = model::select_loaded_nodes(request.options, "Node", request.context);
  check_components("Offset", nodes, request.options, request.context);
  if (request.axes == Axes::directors)
    check_components("Force", nodes, request.options, request.context);
  for (int node : nodes) {
    model::Marker point = model::marker_at(node);
    point.offset = request.vector("Offset");
    load->add_force(point, request.components("Force", point), request.kept_in());
  }
  return load;
}

}  // namespace

void register_force(model::BuilderRegistry& registry) {
  register_both_frames(registry, {"Force", "Force at a point of a node", "Force", "N"},
                       Schema("").add(model::node_field()).add(offset_field()), make_force);
}

}  // namespace culm::load
