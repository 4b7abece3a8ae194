#include <culm/base/error.hpp>
#include <culm/load/couple.hpp>
#include <culm/math/rotation.hpp>
#include <culm/port/point_motion.hpp>

#include <cmath>
#include <numbers>

namespace culm::port {
namespace {

// exp of the vector along a x b by the angle between them; a half-turn about any normal where they
// are opposite
Mat3 shortest_rotation(const Vec3& a, const Vec3& b) {
  const Vec3 normal = a.cross(b);
  const double sine = normal.norm(), cosine = a.dot(b);
  if (sine > 0.0) return exp_rotation(std::atan2(sine, cosine) / sine * normal);
  return cosine > 0.0 ? Mat3::Identity() : exp_rotation(std::numbers::pi * any_normal(a));
}

}  // namespace

Vec3 position(const model::Marker& point, const model::Coordinates& q) {
  Vec3 x = Vec3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    const auto slots = model::NodeTable::slots(q, point.nodes[a]);
    x += point.weights[a] * (slots.col(0) + slots.rightCols<3>() * point.offset);
  }
  return x;
}

Vec3 displacement(const model::Marker& point, const model::Coordinates& from,
                  const model::Coordinates& to) {
  Vec3 moved = Vec3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    const model::NodeSlots change =
        model::NodeTable::slots(to, point.nodes[a]) - model::NodeTable::slots(from, point.nodes[a]);
    moved += point.weights[a] * (change.col(0) + change.rightCols<3>() * point.offset);
  }
  return moved;
}

Mat3 directors(const model::Marker& point, const model::Coordinates& q) {
  Mat3 d = Mat3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    d += point.weights[a] * model::NodeTable::slots(q, point.nodes[a]).rightCols<3>();
  }
  return d;
}

NodeKind kind_of(const model::Marker& point, const model::NodeTable& nodes) {
  const NodeKind kind = nodes.kind(point.nodes.front());
  for (const int node : point.nodes) {
    internal_check(nodes.kind(node) == kind, "a point lies between nodes of two kinds");
  }
  return kind;
}

Mat3 rotation(const model::Marker& point, NodeKind kind, const model::Coordinates& from,
              const model::Coordinates& to) {
  const Mat3 before = directors(point, from), after = directors(point, to);
  if (kind == NodeKind::node6) return shortest_rotation(before.col(0), after.col(0));
  return nearest_rotation(after) * nearest_rotation(before).transpose();
}

Vec3 turn(const model::Marker& point, NodeKind kind, const model::Coordinates& prev,
          const model::Coordinates& next) {
  const Mat3 before = directors(point, prev), after = directors(point, next);
  return load::Couple(0.5 * (before + after), kind).rotation(after - before);
}

}  // namespace culm::port
