/// Where material points are and how they move.
#pragma once

#include <culm/mechanics/node.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/structure.hpp>

namespace culm::port {

/// x = sum_a N_a (x_a + sum_k offset_k d_k,a), linear in the coordinates: of rates the velocity.
Vec3 position(const model::Marker& point, const model::Coordinates& q);

/// How far a point moves from one configuration to another, without loss of digits.
Vec3 displacement(const model::Marker& point, const model::Coordinates& from,
                  const model::Coordinates& to);

/// sum_a N_a d_k,a, not orthonormal between nodes that are turned against each other. Of a shell
/// the first column is its director and the others are zero.
Mat3 directors(const model::Marker& point, const model::Coordinates& q);

/// Kind of the nodes of a point. @pre all are of one kind
NodeKind kind_of(const model::Marker& point, const model::NodeTable& nodes);

/// The rotation of a point from one configuration to another: between the triads nearest to its
/// directors; of a shell the one that turns the director on the shortest way.
Mat3 rotation(const model::Marker& point, NodeKind kind, const model::Coordinates& from,
              const model::Coordinates& to);

/// The rotation vector that moments at the point work on in a step, |tau| = 2 tan(angle / 2).
/// @see load::Couple
Vec3 turn(const model::Marker& point, NodeKind kind, const model::Coordinates& prev,
          const model::Coordinates& next);

}  // namespace culm::port
