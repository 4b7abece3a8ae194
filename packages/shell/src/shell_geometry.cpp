#include <culm/shell/hourglass.hpp>
#include <culm/shell/shell_geometry.hpp>

#include <Eigen/Dense>
#include <fmt/format.h>

#include <array>
#include <cmath>

namespace culm::shell {

namespace {

using ModeVector = Vec<ShellForms::num_modes>;
using FormVector = Vec<ShellForms::num_strains>;

constexpr double corner_xi[] = {-1.0, 1.0, 1.0, -1.0};
constexpr double corner_eta[] = {-1.0, -1.0, 1.0, 1.0};

// Base vectors as sums of modes: g1 = ∂x/∂ξ, g2 = ∂x/∂η, g3 = ∂x/∂ζ at x + ζ d.
ModeVector g1(double eta, double zeta) {
  return (ModeVector() << 1.0, 0.0, eta, 0.0, zeta, 0.0, zeta * eta).finished();
}
ModeVector g2(double xi, double zeta) {
  return (ModeVector() << 0.0, 1.0, xi, 0.0, 0.0, zeta, zeta * xi).finished();
}
ModeVector g3(double xi, double eta) {
  return (ModeVector() << 0.0, 0.0, 0.0, 1.0, xi, eta, xi * eta).finished();
}

// The dot product of two sums of modes as a sum of forms.
FormVector product(const ModeVector& a, const ModeVector& b) {
  FormVector c;
  for (int i = 0; i < ShellForms::num_modes; ++i) {
    for (int j = i; j < ShellForms::num_modes; ++j) {
      c[ShellForms::form(i, j)] = a[i] * b[j] + a[j] * b[i];
    }
  }
  return c;
}

// Voigt components along A_k of tensors with components along contravariant vectors G^i (1.18);
// t_ki = A_k . G^i.
Mat6 to_local(const Mat3& t) {
  constexpr std::array<int, 6> first{0, 1, 2, 1, 0, 0};
  constexpr std::array<int, 6> second{0, 1, 2, 2, 2, 1};
  Mat6 T;
  for (std::size_t row = 0; row < 6; ++row) {
    const int k = first[row];
    const int l = second[row];
    const double engineering = k == l ? 1.0 : 2.0;
    for (std::size_t column = 0; column < 6; ++column) {
      const int i = first[column];
      const int j = second[column];
      T(static_cast<int>(row), static_cast<int>(column)) =
          engineering * 0.5 * (t(k, i) * t(l, j) + t(k, j) * t(l, i));
    }
  }
  return T;
}

}  // namespace

Vec<4> shape_functions(double xi, double eta) {
  Vec<4> N;
  for (int a = 0; a < 4; ++a) {
    N[a] = 0.25 * (1.0 + corner_xi[a] * xi) * (1.0 + corner_eta[a] * eta);
  }
  return N;
}

ShellGeometry::ShellGeometry(const Nodes& reference, double thickness, const ShellOptions& options)
    : reference_(ShellForms::modes(reference)),
      thickness_(thickness),
      options_(options),
      J_centre_(jacobian(0.0, 0.0, 0.0)),
      contravariant_centre_(base_vectors(0.0, 0.0, 0.0).inverse()) {}

ShellGeometry::ShellGeometry(const Nodes& reference, const material::Layup& layup,
                             const ShellOptions& options)
    : ShellGeometry(reference, layup.thickness(), options) {
  const Mat3 A = axes(0.0, 0.0, 0.0);
  hourglass_ = hourglass_factors(A.leftCols<2>().transpose() * reference_.leftCols<2>(), layup);
}

Mat3 ShellGeometry::base_vectors(double xi, double eta, double zeta) const {
  Mat3 G;
  G << reference_ * g1(eta, zeta), reference_ * g2(xi, zeta), reference_ * g3(xi, eta);
  return G;
}

double ShellGeometry::jacobian(double xi, double eta, double zeta) const {
  return base_vectors(xi, eta, zeta).determinant();
}

Mat3 ShellGeometry::axes(double xi, double eta, double zeta, double angle) const {
  const Mat3 G = base_vectors(xi, eta, zeta);
  const Vec3 normal = G.col(0).cross(G.col(1)).normalized();
  const Vec3 axis = options_.reference_axis.isZero(0.0) ? Vec3(G.col(0)) : options_.reference_axis;
  const Vec3 first = (axis - axis.dot(normal) * normal).normalized();
  const Vec3 second = normal.cross(first);
  Mat3 A;
  A << std::cos(angle) * first + std::sin(angle) * second,
      std::cos(angle) * second - std::sin(angle) * first, normal;
  return A;
}

ShellGeometry::StrainMap ShellGeometry::covariant_strains(double xi, double eta,
                                                          double zeta) const {
  const auto shear = [&](double at_xi, double at_eta, const ModeVector& along) {
    return product(along, g3(at_xi, at_eta));
  };
  StrainMap E;
  E.row(0) = 0.5 * product(g1(eta, zeta), g1(eta, zeta));
  E.row(1) = 0.5 * product(g2(xi, zeta), g2(xi, zeta));
  E.row(5) = product(g1(eta, zeta), g2(xi, zeta));
  if (options_.enhancement.membrane > 0) {
    // The square of the hourglass vector x3 + ζ d3 - affine part, which linear enhanced strains
    // cannot balance, enters by its mean times the factors of the wall.
    const Vec3 affine = contravariant_centre_ * (reference_.col(2) + zeta * reference_.col(6));
    ModeVector hourglass = ModeVector::Unit(2) + zeta * ModeVector::Unit(6);
    hourglass[0] = -affine[0];
    hourglass[1] = -affine[1];
    hourglass[3] = -affine[2];
    const FormVector square = 0.5 * product(hourglass, hourglass);
    E.row(0) += (hourglass_[0] / 3.0 - eta * eta) * square;
    E.row(1) += (hourglass_[1] / 3.0 - xi * xi) * square;
    E.row(5) -= 2.0 * xi * eta * square;
  }
  if (options_.assumed_thickness) {
    const Vec<4> N = shape_functions(xi, eta);
    E.row(2).setZero();
    for (int a = 0; a < 4; ++a) {
      const ModeVector director = g3(corner_xi[a], corner_eta[a]);
      E.row(2) += 0.5 * N[a] * product(director, director);
    }
  } else {
    E.row(2) = 0.5 * product(g3(xi, eta), g3(xi, eta));
  }
  if (options_.assumed_shear) {
    E.row(3) = 0.5 * (1.0 - xi) * shear(-1.0, 0.0, g2(-1.0, zeta)) +
               0.5 * (1.0 + xi) * shear(1.0, 0.0, g2(1.0, zeta));
    E.row(4) = 0.5 * (1.0 - eta) * shear(0.0, -1.0, g1(-1.0, zeta)) +
               0.5 * (1.0 + eta) * shear(0.0, 1.0, g1(1.0, zeta));
  } else {
    E.row(3) = shear(xi, eta, g2(xi, zeta));
    E.row(4) = shear(xi, eta, g1(eta, zeta));
  }
  return E;
}

ShellGeometry::EnhancedModes ShellGeometry::covariant_modes(double xi, double eta,
                                                            double zeta) const {
  const Enhancement& enhancement = options_.enhancement;
  EnhancedModes modes = EnhancedModes::Zero(6, enhancement.size());
  int next = 0;
  const auto add = [&](int component, double value) { modes(component, next++) = value; };
  if (enhancement.membrane >= 4) {
    add(0, xi);
    add(1, eta);
    add(5, xi);
    add(5, eta);
  }
  if (enhancement.membrane >= 7) {
    add(0, xi * eta);
    add(1, xi * eta);
    add(5, xi * eta);
  }
  const double height = 2.0 * zeta / thickness_;
  if (enhancement.thickness >= 1) add(2, height);
  if (enhancement.thickness >= 4) {
    add(2, height * xi);
    add(2, height * eta);
    add(2, height * xi * eta);
  }
  return modes;
}

ShellGeometry::Point ShellGeometry::at(double xi, double eta, double zeta, double angle) const {
  const Mat3 G = base_vectors(xi, eta, zeta);
  const Mat3 A = axes(xi, eta, zeta, angle);
  Point point;
  point.J = G.determinant();
  point.strain.noalias() =
      to_local((G.inverse() * A).transpose()) * covariant_strains(xi, eta, zeta);
  // Patch test: modes in the basis of the centre, over the volume of the point (1.17).
  point.enhanced = (J_centre_ / point.J) * (to_local((contravariant_centre_ * A).transpose()) *
                                            covariant_modes(xi, eta, zeta));
  return point;
}

std::vector<std::string> shell_mistakes(const ShellForms::Nodes& reference, double thickness,
                                        const ShellOptions& options) {
  // Volumes and axes of an impossible element may be looked at; strains would be infinite.
  const ShellGeometry geometry(reference, thickness, options);
  for (int a = 0; a < 4; ++a) {
    for (const double zeta : {0.0, -0.5 * thickness, 0.5 * thickness}) {
      const double J = geometry.jacobian(corner_xi[a], corner_eta[a], zeta);
      if (!(J > 0.0)) {
        return {
            fmt::format("the volume at its corner {} is not positive{}: the corners must run "
                        "counter-clockwise seen from the side the directors point to, inner "
                        "angles below 180 degrees, the thickness below the radius of curvature",
                        a + 1, zeta == 0.0 ? "" : " at a face")};
      }
    }
  }
  if (options.reference_axis.isZero(0.0)) return {};
  const Vec3 axis = options.reference_axis.normalized();
  for (int a = 0; a < 4; ++a) {
    const Mat3 A = geometry.axes(corner_xi[a], corner_eta[a], 0.0);
    if (std::abs(axis.dot(A.col(2))) > 0.9999) {  // within 0.8 degrees
      return {"the reference axis points along its normal"};
    }
  }
  return {};
}

}  // namespace culm::shell
