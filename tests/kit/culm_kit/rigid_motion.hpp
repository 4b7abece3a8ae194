/// Rigid motions of slots.
#pragma once

#include <culm/math/rotation.hpp>
#include <culm/mechanics/node.hpp>

#include <random>

namespace culm::kit {

/// A direction far from all axes.
inline const Vec3 oblique = Vec3(0.6, -0.3, 0.8).normalized();

/// Numbers in [-1, 1] that are the same on every machine.
class Random {
 public:
  explicit Random(int seed) : engine_(static_cast<unsigned>(seed)) {}
  double number() { return 2.0 * static_cast<double>(engine_()) / 4294967295.0 - 1.0; }
  template <int R, int C>
  Mat<R, C> matrix() {
    return Mat<R, C>::NullaryExpr([this] { return number(); });
  }
  Vec3 vector() { return matrix<3, 1>(); }
  Mat3 rotation(double largest_angle = 3.0) { return exp_rotation(largest_angle * vector()); }
  /// Symmetric, positive definite, without zeros; eigenvalues between about 0.5 and 10
  template <int N>
  Mat<N, N> positive_matrix() {
    const Mat<N, N> A = matrix<N, N>();
    return A * A.transpose() + 0.5 * Mat<N, N>::Identity();
  }

 private:
  std::mt19937 engine_;
};

/// x -> R x + shift, d -> R d.
struct RigidMotion {
  Mat3 R = Mat3::Identity();
  Vec3 shift = Vec3::Zero();

  static RigidMotion random(int seed) {
    Random random(seed);
    return {random.rotation(), 3.0 * random.vector()};
  }
  /// Moves all slots of nodes of one kind.
  template <int S>
  Slots<S> operator()(const Slots<S>& q, NodeKind kind) const {
    Slots<S> moved = R * q;
    for (int s = 0; s < S; s += slots_of(kind)) moved.col(s) += shift;
    return moved;
  }
};

}  // namespace culm::kit
