/// Where material points are and how they move.
#pragma once

#include <culm/mechanics/node.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/structure.hpp>

namespace culm::port {

/// x = sum_a N_a (x_a + sum_k offset_k d_k,a), linear in the coordinates: of rates the velocity.
Vec3 position(const model::Marker& point, const model::Coordinates& q);

/// sum_a N_a d_k,a, not orthonormal between nodes that are turned against each other; of rates how
/// they change. Of a shell the first column is its director and the others are zero.
Mat3 directors(const model::Marker& point, const model::Coordinates& q);

/// How a point and its directors change from one configuration to another, without loss of digits.
struct Change {
  Vec3 x;
  Mat3 d;
};
Change change(const model::Marker& point, const model::Coordinates& from,
              const model::Coordinates& to);

/// Kind of the nodes of a point. @pre all are of one kind
NodeKind kind_of(const model::Marker& point, const model::NodeTable& nodes);

/// The rotation of a point from some directors to others: between the triads nearest to them; of a
/// shell the one that turns the director on the shortest way.
Mat3 rotation(NodeKind kind, const Mat3& before, const Mat3& after);

/// What loads at a point work on in a step: how it moves, and the rotation vector of its moments,
/// |tau| = 2 tan(angle / 2). @see load::Couple
struct PointMotion {
  Vec3 displacement, turn;
};
PointMotion motion(const model::Marker& point, NodeKind kind, const model::Coordinates& prev,
                   const model::Coordinates& next);

}  // namespace culm::port
