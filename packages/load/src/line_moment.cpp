#include <culm/load/moment_load.hpp>

#include "both_frames.hpp"
#include "line.hpp"
#include "types.hpp"

#include <map>

namespace culm::load {
namespace {

// int N_a ds of each node: virtual rotations are interpolated as positions are
std::map<int, double> lengths_of_nodes(const std::vector<model::LinePoint>& points) {
  std::map<int, double> lengths;
  for (const auto& [marker, length] : points) {
    for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
      lengths[marker.nodes[a]] += length * marker.weights[a];
    }
  }
  return lengths;
}

std::unique_ptr<model::Batch> make_line_moment(const LoadRequest& request) {
  const auto points = line_points(request.options, request.context);
  if (points.empty()) return nullptr;
  refuse_following_moment(request, points.front().marker.nodes);
  auto load = std::make_unique<MomentLoad>(request.effect, request.nodes(), request.function,
                                           request.kept_in());
  for (const auto& [node, length] : lengths_of_nodes(points)) {
    load->add_moment(node, length * request.components("Moment", model::marker_at(node)));
  }
  return load;
}

}  // namespace

void register_line_moment(model::BuilderRegistry& registry) {
  register_both_frames(registry,
                       {"Line Moment", "Moment per reference length of a line", "Moment", "N m/m"},
                       Schema("").add(line_field()), make_line_moment);
}

}  // namespace culm::load
