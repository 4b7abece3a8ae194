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

// The nearest rotation by Newton's method, which few steps from a triad need; else as
// nearest_rotation() finds it. @source Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160-1174
Mat3 quick_nearest_rotation(const Mat3& D) {
  constexpr int most = 8;
  constexpr double settled = 1e-20;  // the next step changes the last digit at most
  Mat3 R = D;
  for (int i = 0; i < most; ++i) {
    const Mat3 next = 0.5 * (R + R.inverse().transpose());
    const double moved = (next - R).squaredNorm();
    R = next;
    if (moved < settled && R.determinant() > 0.0) return R;
  }
  return nearest_rotation(D);
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

Mat3 directors(const model::Marker& point, const model::Coordinates& q) {
  Mat3 d = Mat3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    d += point.weights[a] * model::NodeTable::slots(q, point.nodes[a]).rightCols<3>();
  }
  return d;
}

Change change(const model::Marker& point, const model::Coordinates& from,
              const model::Coordinates& to) {
  Change sum{Vec3::Zero(), Mat3::Zero()};
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    const auto before = model::NodeTable::slots(from, point.nodes[a]);
    const auto after = model::NodeTable::slots(to, point.nodes[a]);
    const Mat3 turned = after.rightCols<3>() - before.rightCols<3>();
    sum.x += point.weights[a] * (after.col(0) - before.col(0) + turned * point.offset);
    sum.d += point.weights[a] * turned;
  }
  return sum;
}

NodeKind kind_of(const model::Marker& point, const model::NodeTable& nodes) {
  const NodeKind kind = nodes.kind(point.nodes.front());
  for (const int node : point.nodes) {
    internal_check(nodes.kind(node) == kind, "a point lies between nodes of two kinds");
  }
  return kind;
}

Mat3 rotation(NodeKind kind, const Mat3& before, const Mat3& after) {
  if (kind == NodeKind::node6) return shortest_rotation(before.col(0), after.col(0));
  return quick_nearest_rotation(after) * quick_nearest_rotation(before).transpose();
}

PointMotion motion(const model::Marker& point, NodeKind kind, const model::Coordinates& prev,
                   const model::Coordinates& next) {
  const Change moved = change(point, prev, next);
  const Mat3 middle = directors(point, prev) + 0.5 * moved.d;
  return {moved.x, load::Couple(middle, kind).rotation(moved.d)};
}

}  // namespace culm::port
