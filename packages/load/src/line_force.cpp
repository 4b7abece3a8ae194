#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "line.hpp"
#include "types.hpp"

namespace culm::load {
namespace {

std::unique_ptr<model::Batch> make(const LoadRequest& request) {
  const model::Structure* line = select_line(request.options, request.context);
  if (line == nullptr) return nullptr;
  auto load = std::make_unique<SlotLoad>(request.effect, request.nodes(), request.function);
  for (model::LinePoint point : line->line_points) {
    point.marker.offset += request.vector("Offset");
    load->add_force(point.marker, point.length * request.vector("Force"), request.frame);
  }
  return load;
}

}  // namespace

void register_line_force(model::BuilderRegistry& registry) {
  register_both_frames(registry,
                       {"Line Force", "Force per reference length of a line", "Force", "N/m"},
                       Schema("").add(model::structure_field()).add(offset_field()), make);
}

}  // namespace culm::load
