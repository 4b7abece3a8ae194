#include <culm/load/moment_load.hpp>

#include "both_frames.hpp"
#include "types.hpp"

namespace culm::load {
namespace {

std::unique_ptr<model::Batch> make_moment(const LoadRequest& request) {
  auto load = std::make_unique<MomentLoad>(request.effect, request.nodes(), request.function,
                                           request.kept_in());
  const auto nodes = model::select_loaded_nodes(request.options, "Node", request.context);
  refuse_following_moment(request, nodes);
  for (int node : nodes) {
    load->add_moment(node, request.components("Moment", model::marker_at(node)));
  }
  return load;
}

}  // namespace

void register_moment(model::BuilderRegistry& registry) {
  register_both_frames(registry, {"Moment", "Moment on a node", "Moment", "N m"},
                       Schema("").add(model::node_field()), make_moment);
}

}  // namespace culm::load
