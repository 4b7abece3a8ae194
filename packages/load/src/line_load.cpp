#include <culm/load/moment_load.hpp>
#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "line.hpp"
#include "read_line_table.hpp"
#include "types.hpp"

#include <algorithm>
#include <map>

namespace culm::load {
namespace {

struct LoadedLine {
  std::vector<model::LinePoint> points;
  std::vector<Vec6> intensities;  ///< of the points
  /// Largest size of each component.
  Vec6 largest() const {
    Vec6 largest = Vec6::Zero();
    for (const Vec6& one : intensities) largest = largest.cwiseMax(one.cwiseAbs());
    return largest;
  }
};

std::unique_ptr<model::Batch> make_forces(const LoadRequest& request, const LoadedLine& line) {
  const std::vector<int>& nodes = line.points.front().marker.nodes;
  check_components("Offset", nodes, request.options, request.context);
  if (request.axes == Axes::directors) {
    const Where& where = request.options.where(source_of("Forces", request.options));
    check_components(line.largest().head<3>(), where, nodes, request.context);
  }
  auto load = std::make_unique<SlotLoad>(request.effect, request.nodes(), request.function);
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    model::LinePoint point = line.points[k];
    const Vec3 force = line.intensities[k].head<3>();
    if (force.isZero(0.0)) continue;
    point.marker.offset += request.vector("Offset");
    load->add_force(point.marker, point.length * request.components(force, point.marker),
                    request.kept_in());
  }
  return load;
}

std::unique_ptr<model::Batch> make_moments(const LoadRequest& request, const LoadedLine& line) {
  refuse_following_moment(request, line.points.front().marker.nodes);
  std::map<int, Vec3> moments;  // int N_a m ds, as virtual rotations are interpolated
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    const auto& [marker, length] = line.points[k];
    for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
      Vec3& moment = moments.try_emplace(marker.nodes[a], Vec3::Zero()).first->second;
      moment += length * marker.weights[a] * line.intensities[k].tail<3>();
    }
  }
  auto load = std::make_unique<MomentLoad>(request.effect.of_part("moments"), request.nodes(),
                                           request.function, request.kept_in());
  for (const auto& [node, moment] : moments) {
    load->add_moment(node, request.components(moment, model::marker_at(node)));
  }
  return load;
}

std::unique_ptr<model::Batch> make_line_load(const LoadRequest& request) {
  LoadedLine line{line_points(request.options, request.context), {}};
  if (line.points.empty()) return nullptr;
  const auto table =
      read_line_table(request.options, length_of(line.points), request.context.issues);
  if (!table) return nullptr;
  line.intensities = intensities(*table, line.points);
  const Vec6 largest = line.largest();
  if (largest.tail<3>().isZero(0.0)) return make_forces(request, line);
  if (largest.head<3>().isZero(0.0)) return make_moments(request, line);
  request.context.model.add_load(make_forces(request, line));
  return make_moments(request, line);
}

}  // namespace

void register_line_load(model::BuilderRegistry& registry) {
  register_both_frames(
      registry, {"Line Load", "Force and moment per reference length of a line by a table", {}, {}},
      Schema("").add(line_field()).add(offset_field()).add_all(line_table_fields()),
      make_line_load);
}

}  // namespace culm::load
