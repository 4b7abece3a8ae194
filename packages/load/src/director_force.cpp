#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "types.hpp"

namespace culm::load {
namespace {

void build_director_force(const Options& options, model::BuildContext& context) {
  const auto function = model::find_function(options, context);
  const auto nodes = model::select_loaded_nodes(options, "Node", context);
  if (!function || nodes.empty()) return;
  const model::NodeTable& table = context.model.nodes();
  auto load = std::make_unique<SlotLoad>(effect_of("Director Force", options), table, *function);
  model::NodeSlots forces = model::NodeSlots::Zero();
  forces.col(1) = model::vector(options, "Force");
  for (int node : nodes) {
    if (table.kind(node) != NodeKind::node6) {
      context.issues.add(options.where("Node"), "node '" + context.model.node_name(node) +
                                                    "' is not one of a shell; a triad takes a "
                                                    "Moment");
      return;
    }
    load->add_slot_forces(node, forces);
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_director_force(model::BuilderRegistry& registry) {
  registry.add("Director Force",
               Schema("Director Force",
                      "Force on the director of a shell node, fixed in space: a dead couple of "
                      "forces on both faces.")
                   .add(model::node_field())
                   .add(model::vector_field("Force", "N m",
                                            "Components in space at function value 1, the force "
                                            "on the upper face times its distance from the "
                                            "lower one."))
                   .add(model::function_field("Ramp")),
               build_director_force);
}

}  // namespace culm::load
