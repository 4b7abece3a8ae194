/// Elements of lines, by the points of their axes that touch.
#pragma once

#include <culm/model/state.hpp>
#include <culm/model/structure.hpp>

#include <vector>

namespace culm::contact {

/// An element with points at even distances of its natural coordinate.
struct LineElement {
  std::vector<int> nodes;
  std::vector<Vec<4>> shapes;   ///< N_a of each point; zero beyond the nodes
  std::vector<double> lengths;  ///< for which each point stands, in the reference [m]
};

/// The elements of a line, whose points are at most `spacing` apart.
/// @param points  of quadrature, those of an element beside each other
std::vector<LineElement> divide(const std::vector<model::LinePoint>& points,
                                const model::Coordinates& reference, double spacing);

/// The place of a point with the shape functions N_a at q.
Vec3 place_on(const LineElement& element, const Vec<4>& shape, const model::Coordinates& q);

/// A ball about an element.
struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;  ///< [m]
};
/// Holds the axis of an element.
Ball ball_about(const LineElement& element, const model::Coordinates& q);

}  // namespace culm::contact
