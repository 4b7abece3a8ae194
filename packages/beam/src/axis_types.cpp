#include <culm/beam/axis_types.hpp>

#include "curve_axes.hpp"
#include "nodes_axis.hpp"

namespace culm::beam {

void register_axes(AxisRegistry& registry) {
  registry.add("Line", line_schema(), make_line);
  registry.add("Polyline", polyline_schema(), make_polyline);
  registry.add("Arc", arc_schema(), make_arc);
  registry.add("Arc Through Points", arc_through_points_schema(), make_arc_through_points);
  registry.add("Helix", helix_schema(), make_helix);
  registry.add("Spline", spline_schema(), make_spline);
  registry.add("Nodes", nodes_schema(), make_nodes);
}

}  // namespace culm::beam
