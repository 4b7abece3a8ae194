/// Parallelograms in homogeneous states of stress, for tests of the hourglass mode.
#pragma once

#include <culm/material/isotropic.hpp>
#include <culm/material/orthotropic.hpp>
#include <culm/mechanics/internal_variables.hpp>
#include <culm/shell/elastic_shell.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace culm::shell {

inline constexpr double degree = std::numbers::pi / 180.0;
inline const double aspects[] = {1.0 / 25.0, 0.2, 1.0, 1.7, 5.0, 25.0};
inline const double skews[] = {0.0, 30.0, 65.0};

using SharedLayup = std::shared_ptr<const material::Layup>;

/// Plies of E1/E2 = 40 with the given angles, or an isotropic wall. Transverse shear is stiffer
/// than shear in the plane, so that the plane decides on stability.
inline SharedLayup fibres(const std::vector<double>& degrees) {
  const material::Material ply{
      material::OrthotropicMaterial::law({40.0, 1.0, 1.0, 0.25, 0.25, 0.25, 0.6, 1.2, 1.2})};
  material::Layup layup;
  for (const double angle : degrees) {
    layup.layers.push_back({ply, 0.1 / static_cast<double>(degrees.size()), angle * degree});
  }
  return std::make_shared<material::Layup>(layup);
}
inline SharedLayup isotropic_wall() {
  return std::make_shared<material::Layup>(
      material::single_layer(material::Material{material::IsotropicMaterial::law(1.0, 0.3)}, 0.1));
}

struct Wall {
  std::string name;
  SharedLayup layup;
};
inline std::vector<Wall> walls() {
  return {{"isotropic", isotropic_wall()},
          {"[0]", fibres({0})},
          {"[45]", fibres({45})},
          {"[90]", fibres({90})},
          {"[0/90/90/0]", fibres({0, 90, 90, 0})},
          {"[45/-45]", fibres({45, -45})},
          {"[0/90]", fibres({0, 90})}};
}

/// Sides of the lengths size / sqrt(aspect), along x, and size * sqrt(aspect), turned by `skew`
/// degrees from y.
inline ShellForms::Nodes parallelogram(double aspect, double skew, double size = 1.0) {
  const Vec3 first(0.5 * size / std::sqrt(aspect), 0.0, 0.0);
  const Vec3 second =
      0.5 * size * std::sqrt(aspect) * Vec3(std::sin(skew * degree), std::cos(skew * degree), 0.0);
  ShellForms::Nodes q;
  q << -first - second, Vec3::UnitZ(), first - second, Vec3::UnitZ(), first + second, Vec3::UnitZ(),
      second - first, Vec3::UnitZ();
  return q;
}

inline ShellOptions along_x(const Enhancement& enhancement = {}) {
  return {.enhancement = enhancement, .reference_axis = Vec3::UnitX()};
}

/// Stiffness of an element at rest in `q`, in the components of its slots.
template <class E>
RowMat<24, 24> tangent(const E& element, const ShellForms::Nodes& q) {
  ShellForms::Strain y;
  element.strain(0, q, y);
  Response<ShellForms::num_strains> response;
  if constexpr (ElementWithInternals<E>) {
    typename E::Internals alpha = E::Internals::Zero();
    element.respond(0, y, y, alpha, Stencil::statics(), alpha, response);
  } else {
    element.respond(0, y, y, Stencil::statics(), response);
  }
  RowMat<24, 24> K = RowMat<24, 24>::Zero();
  E::add_stiffness(q, q, response.tangent, 1.0, K);
  SlotMatrix<8> A = SlotMatrix<8>::Zero();
  element.add_curvature(0, response.stress, A);
  for (int i = 0; i < 24; ++i) {
    for (int j = i % 3; j < 24; j += 3) K(i, j) += A(i / 3, j / 3);
  }
  return K;
}

/// Whether a Hermitian matrix is positive definite, by elimination.
inline bool is_positive(Eigen::MatrixXcd A) {
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    if (!(A(k, k).real() > 0.0)) return false;
    for (Eigen::Index i = k + 1; i < A.rows(); ++i) {
      const std::complex<double> factor = A(i, k) / A(k, k);
      for (Eigen::Index j = k + 1; j < A.rows(); ++j) A(i, j) -= factor * A(k, j);
    }
  }
  return true;
}

/// Eigenvalues of a symmetric matrix in ascending order.
inline Vec<2> eigenvalues(const Mat<2, 2>& A) {
  const double mean = 0.5 * (A(0, 0) + A(1, 1));
  const double radius = std::hypot(0.5 * (A(0, 0) - A(1, 1)), A(0, 1));
  return {mean - radius, mean + radius};
}

/// Gradients along a normal by displacements: N^T C N is the acoustic tensor in the plane.
inline Mat<3, 2> gradients_along(const Vec<2>& n) {
  Mat<3, 2> N;
  N << n[0], 0.0, 0.0, n[1], n[1], n[0];
  return N;
}

/// Whether an infinite lattice of equal elements is stable against all waves of displacements in
/// its plane and of directors: motions exp(i k . p) of the nodes p, the deflection held. The period
/// of the shortest is two elements, of the longest 16.
inline bool waves_are_stable(const RowMat<24, 24>& K) {
  constexpr int steps = 8;
  constexpr int moving[] = {0, 1, 3, 4, 5};  // of x, y, z, d1, d2, d3
  constexpr double right[] = {0, 1, 1, 0};
  constexpr double up[] = {0, 0, 1, 1};
  for (int along = 0; along <= steps; ++along) {
    for (int across = -steps; across <= steps; ++across) {
      if (along == 0 && across <= 0) continue;  // k = 0 is a rigid motion, -k the same wave as k
      Eigen::MatrixXcd wave = Eigen::MatrixXcd::Zero(5, 5);
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) {
          const std::complex<double> phase =
              std::polar(1.0, std::numbers::pi / steps *
                                  (along * (right[b] - right[a]) + across * (up[b] - up[a])));
          for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j)
              wave(i, j) += phase * K(6 * a + moving[i], 6 * b + moving[j]);
          }
        }
      }
      if (!is_positive(std::move(wave))) return false;
    }
  }
  return true;
}

/// A wall under uniform strain in its plane, by laminate theory.
struct StrainedWall {
  StrainedWall(const material::Layup& layup, const Vec3& in_plane)
      : stiffness(material::laminate_stiffness(layup)) {
    // the root of C = 1 + 2 E by its invariants
    const Mat<2, 2> squared = metric(in_plane);
    const double area = std::sqrt(squared(0, 0) * squared(1, 1) - squared(0, 1) * squared(0, 1));
    stretch = (squared + area * Mat<2, 2>::Identity()) / std::sqrt(squared.trace() + 2.0 * area);
    stress.head<3>() = stiffness.topLeftCorner<3, 3>() * in_plane;
    stress.tail<3>() = stiffness.bottomLeftCorner<3, 3>() * in_plane;
    double force = 0.0;
    double resistance = 0.0;
    double bottom = -0.5 * layup.thickness();
    for (const material::Layer& layer : layup.layers) {
      const Mat6& C = material::small_strain_stiffness(layer.material.law);
      const double c = std::cos(layer.angle);
      const double s = std::sin(layer.angle);
      const double along = c * c * in_plane[0] + s * s * in_plane[1] + s * c * in_plane[2];
      const double across = in_plane[0] + in_plane[1] - along;
      force += layer.thickness * (C(2, 0) * along + C(2, 1) * across);
      resistance += layer.thickness * C(2, 2);
      // second moments of the stress
      const double top = bottom + layer.thickness;
      material::Layup ply{{layer}};
      const Mat3 Q = material::laminate_stiffness(ply).topLeftCorner<3, 3>() / layer.thickness;
      second_moment += (top * top * top - bottom * bottom * bottom) / 3.0 * Q * in_plane;
      bottom = top;
    }
    thickness_stretch = std::sqrt(1.0 - 2.0 * force / resistance);
  }
  static Mat<2, 2> metric(const Vec3& E) {
    return (Mat<2, 2>() << 1.0 + 2.0 * E[0], E[2], E[2], 1.0 + 2.0 * E[1]).finished();
  }

  /// Nodes of an element, or of many, that is strained with the wall.
  template <class Nodes>
  Nodes strained(const Nodes& reference) const {
    Mat3 F = Mat3::Zero();
    F.topLeftCorner<2, 2>() = stretch;
    F(2, 2) = thickness_stretch;
    return F * reference;
  }

  /// Whether the wall is stable against short waves of the displacements u + ζ d in its plane: the
  /// acoustic tensor of any normal n, (F N)^T C N F^T + S_nn, weighted by 1, ζ, ζ^2.
  bool is_stable() const {
    for (int i = 0; i < 180; ++i) {
      const Vec<2> n(std::cos(i * degree), std::sin(i * degree));
      const Mat<3, 2> NF = gradients_along(n) * stretch;
      const auto across = [&](const Vec3& S) {
        return n[0] * n[0] * S[0] + n[1] * n[1] * S[1] + 2.0 * n[0] * n[1] * S[2];
      };
      const Vec3 moments[] = {stress.head<3>(), stress.tail<3>(), second_moment};
      Eigen::MatrixXcd acoustic(4, 4);
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 2; ++c) {
          const Mat<2, 2> part = NF.transpose() * stiffness.block<3, 3>(3 * r, 3 * c) * NF +
                                 across(moments[r + c]) * Mat<2, 2>::Identity();
          acoustic.block<2, 2>(2 * r, 2 * c) = part;
        }
      }
      if (!is_positive(std::move(acoustic))) return false;
    }
    return true;
  }

  Mat6 stiffness;
  Mat<2, 2> stretch;
  double thickness_stretch = 1.0;
  Vec6 stress;                        // forces and moments
  Vec3 second_moment = Vec3::Zero();  // of the stress
};

/// Stresses 11, 22, 12.
inline const std::vector<Vec3>& loadings() {
  static const std::vector<Vec3> all{{-1, 0, 0}, {0, -1, 0},   {-1, -1, 0},
                                     {0, 0, 1},  {-1, 0, 0.5}, {-1, 0.5, 0}};
  return all;
}

/// Membrane strains by forces, the wall free to bend [m/N].
inline Mat3 membrane_compliance(const material::Layup& layup) {
  return material::laminate_stiffness(layup).inverse().topLeftCorner<3, 3>();
}

/// The strain in which a wall that is free to bend carries a stress, its largest principal value
/// one.
inline Vec3 strain_under(const Vec3& stress, const material::Layup& layup) {
  const Vec3 strain = membrane_compliance(layup) * stress;
  const Mat<2, 2> tensor = 0.5 * (StrainedWall::metric(strain) - Mat<2, 2>::Identity());
  return strain / eigenvalues(tensor).cwiseAbs().maxCoeff();
}

/// The largest strain up to `most` at which something stays true.
template <class Condition>
double last(double most, const Condition& holds) {
  if (holds(most)) return most;
  double low = 0.0;
  double high = most;
  while (high - low > 1e-3 * high) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace culm::shell
