/// Quadrature on the bilinear faces of shells.
#pragma once

#include <culm/math/types.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/structure.hpp>

#include <array>

namespace culm::load {

/// A point of a face: the shape functions of its four nodes and their derivatives.
struct FacePoint {
  Vec<4> N, N_xi, N_eta;
};

/// The 2x2 Gauss points, weight one each. Pressure is quadratic in both directions: exact.
inline const std::array<FacePoint, 4>& face_points() {
  static const std::array<FacePoint, 4> points = [] {
    constexpr double g = 0.57735026918962576451;  // 1 / sqrt(3)
    const Vec<4> xi_a(-1.0, 1.0, 1.0, -1.0);
    const Vec<4> eta_a(-1.0, -1.0, 1.0, 1.0);
    std::array<FacePoint, 4> result;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto at = static_cast<int>(i);
      const Vec<4> along = (1.0 + g * xi_a[at] * xi_a.array()).matrix();
      const Vec<4> across = (1.0 + g * eta_a[at] * eta_a.array()).matrix();
      result[i] = {0.25 * along.cwiseProduct(across), 0.25 * xi_a.cwiseProduct(across),
                   0.25 * eta_a.cwiseProduct(along)};
    }
    return result;
  }();
  return points;
}

/// Corners x_a + zeta d_a of a face, from the slots of its nodes side by side, shape (3, 16).
template <class ItemSlots>
Mat<3, 4> corners(const ItemSlots& q, double zeta) {
  Mat<3, 4> X;
  for (int a = 0; a < 4; ++a) X.col(a) = q.col(4 * a) + zeta * q.col(4 * a + 1);
  return X;
}

}  // namespace culm::load
