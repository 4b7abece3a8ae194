/// The stress-free axis of a beam as nodes with triads.
#pragma once

#include <culm/beam/curve.hpp>
#include <culm/math/types.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace culm::beam {

/// A node on the axis.
struct AxisNode {
  Vec3 position = Vec3::Zero();   ///< [m]
  Mat3 triad = Mat3::Identity();  ///< d1, d2, d3; d3 along the axis
  double span = 0.0;              ///< arc length from the start over the whole length [-]
};

/// Nodes of a stretch without kinks, from its first to its last; elements share their end nodes.
using Chain = std::vector<AxisNode>;

/// Chains one behind the other. Where one ends and the next begins there are two nodes at one
/// place, because a section cannot stand across both directions of a kink.
struct Axis {
  std::vector<Chain> chains;
};

/// A curve and the number of elements on it.
struct Segment {
  Curve curve;
  int elements = 1;
};

/// How many nodes stand on an element of the deck.
struct Density {
  int order = 1;       ///< of the elements
  int refinement = 1;  ///< elements for each one of the deck

  /// Distances between nodes on an element of the deck.
  int intervals() const { return order * refinement; }
};

/// How triads stand around the tangent d3.
struct Orientation {
  Vec3 up = Vec3::UnitX();              ///< d1 is as near to it as the tangent allows
  std::function<double(double)> twist;  ///< angle about d3 at a span [rad]; added to that
};

/// Places the nodes at equal arc lengths on each segment, `intervals` + 1 on each element. Segments
/// that meet without a kink share a node, others begin a new chain.
///
/// d1 is the projection of `up` on the plane normal to the tangent (and not transported from node
/// to node), so that the triad at a place depends on nothing but that place.
/// @pre `up` is nowhere parallel to the tangent, see find_parallel
Axis place_nodes(const std::vector<Segment>& segments, int intervals,
                 const Orientation& orientation);

/// Span of the first node whose tangent is within a milliradian of `up`; none if there is none.
std::optional<double> find_parallel(const std::vector<Segment>& segments, int intervals,
                                    const Vec3& up);

}  // namespace culm::beam
