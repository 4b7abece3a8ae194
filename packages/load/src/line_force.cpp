#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "line.hpp"
#include "types.hpp"

namespace culm::load {
namespace {

std::unique_ptr<model::Batch> make_line_force(const LoadRequest& request) {
  const auto points = line_points(request.options, request.context);
  if (points.empty()) return nullptr;
  auto load = std::make_unique<SlotLoad>(request.effect, request.nodes(), request.function);
  const auto& nodes = points.front().marker.nodes;
  check_components("Offset", nodes, request.options, request.context);
  if (request.axes == Axes::directors)
    check_components("Force", nodes, request.options, request.context);
  for (model::LinePoint point : points) {
    point.marker.offset += request.vector("Offset");
    load->add_force(point.marker, point.length * request.components("Force", point.marker),
                    request.kept_in());
  }
  return load;
}

}  // namespace

void register_line_force(model::BuilderRegistry& registry) {
  register_both_frames(registry,
                       {"Line Force", "Force per reference length of a line", "Force", "N/m"},
                       Schema("").add(line_field()).add(offset_field()), make_line_force);
}

}  // namespace culm::load
