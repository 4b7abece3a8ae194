#include <culm/beam/axis.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <cmath>

namespace culm::beam {

namespace {

double total_length(const std::vector<Segment>& segments) {
  double length = 0.0;
  for (const Segment& segment : segments) length += segment.curve.length;
  return length;
}

// Calls visit(segment, s, span) for all nodes of all segments, first and last included.
template <class Visit>
void for_each_node(const std::vector<Segment>& segments, int per_element, Visit&& visit) {
  const double total = total_length(segments);
  double before = 0.0;
  for (const Segment& segment : segments) {
    const int intervals = segment.elements * per_element;
    for (int i = 0; i <= intervals; ++i) {
      const double s = segment.curve.length * i / intervals;
      visit(segment, i, s, (before + s) / total);
    }
    before += segment.curve.length;
  }
}

}  // namespace

Axis place_nodes(const std::vector<Segment>& segments, int intervals,
                 const Orientation& orientation) {
  Axis axis;
  for_each_node(segments, intervals, [&](const Segment& segment, int i, double s, double span) {
    const Mat3 untwisted = triad_along(segment.curve.tangent(s), orientation.up);
    const double angle = orientation.twist ? orientation.twist(span) : 0.0;
    const AxisNode node{segment.curve.position(s), untwisted * exp_rotation(angle * Vec3::UnitZ()),
                        span};
    if (i == 0) {
      const bool continues =
          !axis.chains.empty() &&
          (axis.chains.back().back().triad.col(2) - node.triad.col(2)).norm() < 1e-9;
      if (continues) return;  // the last node of the segment before is this one
      axis.chains.emplace_back();
    }
    axis.chains.back().push_back(node);
  });
  return axis;
}

std::optional<double> find_parallel(const std::vector<Segment>& segments, int intervals,
                                    const Vec3& up) {
  std::optional<double> found;
  for_each_node(segments, intervals, [&](const Segment& segment, int, double s, double span) {
    const double sine = segment.curve.tangent(s).cross(up).norm() / up.norm();
    // an axis beyond the range of numbers has no places
    if (!found && !(sine > 1e-3) && std::isfinite(span)) found = span;
  });
  return found;
}

}  // namespace culm::beam
