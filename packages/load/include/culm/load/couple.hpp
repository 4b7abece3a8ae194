/// Moments at material points as forces on directors.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/node.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace culm::load {

/// How a moment m at a point spreads on its directors, the columns of d:
///   f_i = mh x d_i      mh = J m      J = Ac^-1      Ac = sum_i ( |d_i|^2 1 - d_i d_i^T )
/// Then sum_i d_i x f_i = m also where the directors are not orthonormal, as between nodes and in
/// the middle of a step, and the work of f_i over changes Dd_i is m . tau with
///   tau = J sum_i d_i x Dd_i
/// A point of a shell has one director, J = 1 / (d . d): the part of m along it is not carried, and
/// tau has none. @source formulation 2.4, 3.1, 3.2
class Couple {
 public:
  /// @param directors  columns d_i; of a shell the second and third are zero
  Couple(const Mat3& directors, NodeKind kind) : d_(directors), kind_(kind) {
    const double square = d_.squaredNorm();
    if (kind_ == NodeKind::node6) {
      inverse_ = Mat3::Identity() / square;
    } else {
      inverse_ = (square * Mat3::Identity() - d_ * d_.transpose()).inverse();
    }
  }

  /// Forces on the directors, columns f_i [N m].
  Mat3 forces(const Vec3& moment) const { return skew(inverse_ * moment) * d_; }

  /// The rotation vector tau of a change of the directors, or the angular velocity of their rates.
  Vec3 rotation(const Mat3& change) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 3; ++i) sum += d_.col(i).cross(change.col(i));
    return inverse_ * sum;
  }

  /// Derivative of the forces by the moment, blocks i of shape (3, 3): -[d_i] J.
  Mat<9, 3> by_moment() const {
    Mat<9, 3> K;
    for (int i = 0; i < 3; ++i) K.block<3, 3>(3 * i, 0) = -skew(d_.col(i)) * inverse_;
    return K;
  }

  /// Derivative of the forces by the directors, blocks (i, j) of shape (3, 3):
  ///   df_i / dd_j = delta_ij [mh] - [d_i] G_j
  ///   G_j = dmh / dd_j = J ( (d_j . mh) 1 + d_j mh^T - 2 mh d_j^T ),  of a shell J (-2 mh d^T)
  Mat<9, 9> derivative(const Vec3& moment) const {
    const Vec3 mh = inverse_ * moment;
    Mat<9, 9> K;
    for (int j = 0; j < 3; ++j) {
      Mat3 G = -2.0 * mh * d_.col(j).transpose();
      if (kind_ == NodeKind::node12) {
        G += d_.col(j) * mh.transpose();
        G.diagonal().array() += d_.col(j).dot(mh);
      }
      G = inverse_ * G.eval();
      for (int i = 0; i < 3; ++i) K.block<3, 3>(3 * i, 3 * j) = -skew(d_.col(i)) * G;
      K.block<3, 3>(3 * j, 3 * j) += skew(mh);
    }
    return K;
  }

 private:
  Mat3 d_;
  NodeKind kind_;
  Mat3 inverse_;
};

/// Couple(d, kind).rotation(change), for passes over many points: Ac is symmetric, and one solution
/// needs its cofactors only. Without a call, which would cost a third of it.
/// @param d, change  columns, any matrices of shape (3, 3)
template <class Directors, class Change>
[[gnu::always_inline]] inline Vec3 couple_rotation(const Directors& d, const Change& change,
                                                   NodeKind kind) {
  if (kind == NodeKind::node6) return d.col(0).cross(change.col(0)) / d.col(0).squaredNorm();
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;  // sum_i d_i d_i^T
  double a = 0.0, b = 0.0, c = 0.0;                                   // sum_i d_i x Dd_i
  for (int i = 0; i < 3; ++i) {
    const double x = d(0, i), y = d(1, i), z = d(2, i);
    const double dx = change(0, i), dy = change(1, i), dz = change(2, i);
    xx += x * x;
    yy += y * y;
    zz += z * z;
    xy += x * y;
    xz += x * z;
    yz += y * z;
    a += y * dz - z * dy;
    b += z * dx - x * dz;
    c += x * dy - y * dx;
  }
  const double first = yy + zz, second = xx + zz, third = xx + yy;  // diagonal of Ac
  const double ff = second * third - yz * yz, fs = xy * third + xz * yz, ft = xy * yz + xz * second;
  const double ss = first * third - xz * xz, st = first * yz + xy * xz,
               tt = first * second - xy * xy;
  const double scale = 1.0 / (first * ff - xy * fs - xz * ft);
  return scale * Vec3(ff * a + fs * b + ft * c, fs * a + ss * b + st * c, ft * a + st * b + tt * c);
}

}  // namespace culm::load
