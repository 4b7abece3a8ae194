/// Points in space attached to the nearest places of structures.
#pragma once

#include <culm/model/model.hpp>
#include <culm/port/place.hpp>

#include <span>
#include <vector>

namespace culm::port {

/// Weights of nodes for the points of lines.
enum class Weights {
  elements,  ///< those of the elements: surfaces have kinks at the ends of elements
  smooth,  ///< cubic through neighbouring nodes: surfaces are smooth, third order in their distance
};

/// A cloud of points of a partner and where they belong.
struct Projection {
  std::vector<Place> places;      ///< of all points, in their order
  std::vector<std::size_t> lost;  ///< points without a place: beyond the rim of surfaces
};

/// Finds for each point the nearest place of some structures in the reference: in the cross-section
/// of a line through it, on the director of a surface through it, or in the triad of a single node.
/// The place, with its offset, is exactly at the point. Past the ends of lines, and in the gap of
/// cross-sections outside of a kink, a point belongs to the node; past the rim of a surface it
/// belongs to the face prolonged by up to half of its size.
/// @param cloud       3 numbers per point [m]
/// @param structures  numbers of structures in the model
/// @param weights     how points between the nodes of lines move with them
Projection project(const model::Model& model, std::span<const double> cloud,
                   const std::vector<int>& structures, Weights weights);

/// A point of a cell at natural coordinates, with an offset in the directors there. Of a surface
/// only the first component of the offset counts.
Place place_in_cell(const model::Model& model, int structure, int cell,
                    const Eigen::Vector2d& natural, const Vec3& offset);

}  // namespace culm::port
