#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "types.hpp"

#include <memory>

namespace culm::load {
namespace {

// f = M (g on all position slots). @source formulation 3.3
model::Coordinates weight(const model::Model& model, const Vec3& g) {
  model::Coordinates acceleration(model.nodes().reference().size(), 0.0);
  for (int node = 0; node < model.nodes().size(); ++node) {
    model::NodeTable::slots(acceleration, node).col(0) = g;
  }
  return model.mass_times(acceleration);
}

void build_gravity(const Options& options, model::BuildContext& context) {
  const auto function = model::find_function(options, context);
  if (!function) return;
  if (context.model.mass() == 0.0) {
    context.issues.add(options.where(), "acts on nothing: no structure has mass");
    return;
  }
  const auto& nodes = context.model.nodes();
  const auto forces = weight(context.model, model::vector(options, "Acceleration"));
  auto load = std::make_unique<SlotLoad>(effect_of("Gravity", options), nodes, *function);
  for (int node = 0; node < nodes.size(); ++node) {
    const auto force = model::NodeTable::slots(forces, node);
    if (!force.isZero(0.0)) load->add_slot_forces(node, force);
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_gravity(model::BuilderRegistry& registry) {
  registry.add("Gravity",
               Schema("Gravity", "Weight of all structures.")
                   .add(model::vector_field("Acceleration", "m/s^2",
                                            "Acceleration of free fall at function value 1.")
                            .optional({0.0, 0.0, -9.81}))
                   .add(model::function_field("Constant")),
               build_gravity);
}

}  // namespace culm::load
