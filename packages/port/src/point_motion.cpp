#include <culm/base/error.hpp>
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

// The nearest rotation by Newton's method, R <- (R + R^-T) / 2, which few steps from a triad need;
// else as nearest_rotation() finds it.
// @source Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160-1174
Mat3 quick_nearest_rotation(const Mat3& D) {
  constexpr int most = 8;
  constexpr double settled = 1e-16;  // the next step changes half of this at most
  Mat3 R = D;
  for (int i = 0; i < most; ++i) {
    Mat3 cofactors;
    cofactors << R.col(1).cross(R.col(2)), R.col(2).cross(R.col(0)), R.col(0).cross(R.col(1));
    const double determinant = cofactors.col(0).dot(R.col(0));
    if (!(determinant > 0.0)) break;
    const Mat3 next = 0.5 * R + (0.5 / determinant) * cofactors;
    const double moved = (next - R).squaredNorm();
    R = next;
    if (moved < settled) return R;
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

NodeKind kind_of(const model::Marker& point, const model::NodeTable& nodes) {
  const NodeKind kind = nodes.kind(point.nodes.front());
  for (const int node : point.nodes) {
    internal_check(nodes.kind(node) == kind, "a point lies between nodes of two kinds");
  }
  return kind;
}

FlatPoint::FlatPoint(const model::Marker& point, const model::NodeTable& nodes)
    : kind_(kind_of(point, nodes)),
      count_(static_cast<int>(point.nodes.size())),
      offset_(point.offset) {
  internal_check(count_ <= max_nodes, "a point lies between more nodes than ports provide for");
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    firsts_[a] = model::NodeTable::offset(point.nodes[a]);
    weights_[a] = point.weights[a];
  }
  const Mat3 directors = slots(nodes.reference()).rightCols<3>();
  reference_ = kind_ == NodeKind::node6 ? directors : quick_nearest_rotation(directors);
}

Mat3 FlatPoint::rotation(const Mat3& directors) const {
  if (kind_ == NodeKind::node6) return shortest_rotation(reference_.col(0), directors.col(0));
  return quick_nearest_rotation(directors) * reference_.transpose();
}

}  // namespace culm::port
