#include <culm/material/section.hpp>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <cmath>

namespace culm::material {

namespace {

// Smallest eigenvalue of D A D with D = 1 / sqrt(diagonal): without units, so that one tolerance
// serves N, N m and N m^2.
template <int N>
double smallest_scaled_eigenvalue(const Mat<N, N>& A) {
  Vec<N> scale;
  for (int i = 0; i < N; ++i) scale[i] = A(i, i) > 0.0 ? 1.0 / std::sqrt(A(i, i)) : 1.0;
  const Mat<N, N> scaled = scale.asDiagonal() * A * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Mat<N, N>>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

template <int N>
std::vector<std::string> form_mistakes(const Mat<N, N>& A, const std::string& what) {
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < i; ++j) {
      const double size = std::sqrt(std::abs(A(i, i) * A(j, j))) + std::abs(A(i, j));
      if (std::abs(A(i, j) - A(j, i)) > 1e-9 * size) {
        return {fmt::format("{} is not symmetric: entry ({}, {}) is {} but ({}, {}) is {}", what,
                            i + 1, j + 1, A(i, j), j + 1, i + 1, A(j, i))};
      }
    }
  }
  for (int i = 0; i < N; ++i) {
    if (A(i, i) < 0.0) {
      return {fmt::format("{} has the negative diagonal entry ({}, {}) = {}", what, i + 1, i + 1,
                          A(i, i))};
    }
  }
  const double smallest = smallest_scaled_eigenvalue(A);
  if (smallest < -1e-9) {
    return {
        fmt::format("{} is not positive semidefinite: its smallest eigenvalue, with the "
                    "diagonal scaled to one, is {:.3g}",
                    what, smallest)};
  }
  return {};
}

// Of fibres that are stretched by Γ3 + K1 xi2 - K2 xi1, against (Γ3, K1, K2).
Mat3 fibre_stiffness(const Section& section) {
  Mat3 sum = Mat3::Zero();
  for (const Fibre& fibre : section.fibres) {
    const Vec3 stretch(1.0, fibre.place[1], -fibre.place[0]);
    sum += section.plasticity.young_modulus() * fibre.area * stretch * stretch.transpose();
  }
  return sum;
}

Mat<2, 2> turn(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return (Mat<2, 2>() << c, -s, s, c).finished();
}

}  // namespace

Mat6 stiffness_matrix(const StiffnessValues& v) {
  Mat6 C;
  C << v.GA1, 0.0, 0.0, 0.0, 0.0, -v.GS1,     //
      0.0, v.GA2, 0.0, 0.0, 0.0, v.GS2,       //
      0.0, 0.0, v.EA, v.ES1, -v.ES2, 0.0,     //
      0.0, 0.0, v.ES1, v.EI1, -v.EI12, 0.0,   //
      0.0, 0.0, -v.ES2, -v.EI12, v.EI2, 0.0,  //
      -v.GS1, v.GS2, 0.0, 0.0, 0.0, v.GIp;
  return C;
}

Mat3 mass_matrix(const MassValues& v) {
  Mat3 m;
  m << v.rhoA, v.rhoS2, v.rhoS1, v.rhoS2, v.rhoI2, v.rhoI12, v.rhoS1, v.rhoI12, v.rhoI1;
  return m;
}

Mat6 full_mass(const Mat3& mass) {
  const Vec3 first(mass(0, 1), mass(0, 2), 0.0);  // m c
  Mat6 M = Mat6::Zero();
  M.topLeftCorner<3, 3>().diagonal().setConstant(mass(0, 0));
  M.bottomLeftCorner<3, 3>() = skew(first);
  M.topRightCorner<3, 3>() = -skew(first);
  M.bottomRightCorner<3, 3>().diagonal() << mass(2, 2), mass(1, 1), mass(1, 1) + mass(2, 2);
  M(3, 4) = M(4, 3) = -mass(1, 2);
  return M;
}

Mat3 plane_mass(const Mat6& mass) {
  return mass_matrix({.rhoA = mass(0, 0),
                      .rhoI1 = mass(3, 3),
                      .rhoI2 = mass(4, 4),
                      .rhoS1 = mass(2, 3),
                      .rhoS2 = -mass(2, 4),
                      .rhoI12 = -mass(3, 4)});
}

// m3 = m (1, c) (1, c)^T + J of the centre c; without mass there is nothing but J
Mat3 with_rotary_inertia(const Mat3& mass, double factor) {
  const double m = mass(0, 0);
  if (!(m > 0.0)) return factor * mass;
  const Vec3 point = mass.col(0) / m;
  const Mat3 at_centre = m * point * point.transpose();
  return at_centre + factor * (mass - at_centre);
}

// Strains in the section's own axes: e_own = diag(Q^T, Q^T) e, points: xi = Q2 xi_own.
Section rotated(const Section& section, double angle) {
  const Mat<2, 2> Q2 = turn(angle);
  Mat6 T = Mat6::Identity();
  T.topLeftCorner<2, 2>() = Q2.transpose();
  T.block<2, 2>(3, 3) = Q2.transpose();
  Mat3 P = Mat3::Identity();
  P.bottomRightCorner<2, 2>() = Q2;
  Section result{T.transpose() * section.stiffness * T,
                 P * section.mass * P.transpose(),
                 {},
                 section.expansion,
                 section.fibres,
                 section.pattern,
                 section.plasticity};
  for (const Vec<2>& point : section.outline) result.outline.emplace_back(Q2 * point);
  for (Fibre& fibre : result.fibres) fibre.place = Q2 * fibre.place;
  return result;
}

// Strains at the section's own origin: Γ_own = Γ + K x offset = Γ - [offset] K, points:
// xi = xi_own + offset.
Section shifted(const Section& section, const Vec<2>& offset) {
  Mat6 T = Mat6::Identity();
  T.topRightCorner<3, 3>() = -skew(Vec3(offset[0], offset[1], 0.0));
  Mat3 P = Mat3::Identity();
  P.bottomLeftCorner<2, 1>() = offset;
  Section result{T.transpose() * section.stiffness * T,
                 P * section.mass * P.transpose(),
                 {},
                 section.expansion,
                 section.fibres,
                 section.pattern,
                 section.plasticity};
  for (const Vec<2>& point : section.outline) result.outline.emplace_back(point + offset);
  for (Fibre& fibre : result.fibres) fibre.place += offset;
  return result;
}

Section placed(const Section& section, double angle, const Vec<2>& offset) {
  Section result = shifted(rotated(section, angle), offset);
  result.angle = angle;
  result.offset = offset;
  return result;
}

namespace {

// As it is about its own origin and axes.
Section own(const Section& section) {
  return rotated(shifted(section, -section.offset), -section.angle);
}

}  // namespace

Section interpolate(const Section& a, const Section& b, double t) {
  if (a.offset != b.offset || a.angle != b.angle) {
    return placed(interpolate(own(a), own(b), t), (1.0 - t) * a.angle + t * b.angle,
                  (1.0 - t) * a.offset + t * b.offset);
  }
  // without rounding where nothing changes, so that elements of a uniform beam are the same
  const auto between = [t](const auto& start, const auto& end) {
    return start == end ? start : ((1.0 - t) * start + t * end).eval();
  };
  Section result{between(a.stiffness, b.stiffness),
                 between(a.mass, b.mass),
                 t < 0.5 ? a.outline : b.outline,
                 (1.0 - t) * a.expansion + t * b.expansion,
                 a.fibres,
                 a.pattern,
                 UniaxialPlasticity::interpolate(a.plasticity, b.plasticity, t),
                 a.offset,
                 a.angle};
  for (std::size_t i = 0; i < result.fibres.size(); ++i) {
    Fibre& fibre = result.fibres[i];
    fibre.place = (1.0 - t) * fibre.place + t * b.fibres[i].place;
    fibre.area = (1.0 - t) * fibre.area + t * b.fibres[i].area;
  }
  // what is not the fibres' would stay elastic for ever: their second moments are no linear
  // function
  result.stiffness.block<3, 3>(2, 2) +=
      fibre_stiffness(result) - (1.0 - t) * fibre_stiffness(a) - t * fibre_stiffness(b);
  if (a.outline.size() == b.outline.size()) {
    for (std::size_t i = 0; i < a.outline.size(); ++i) {
      result.outline[i] = (1.0 - t) * a.outline[i] + t * b.outline[i];
    }
  }
  return result;
}

std::vector<std::string> stiffness_mistakes(const Mat6& stiffness) {
  if (stiffness.isZero(0.0)) return {"the stiffness is zero"};
  return form_mistakes<6>(stiffness, "the stiffness");
}

std::vector<std::string> mass_mistakes(const Mat3& mass) {
  return form_mistakes<3>(mass, "the mass");
}

std::vector<std::string> full_mass_mistakes(const Mat6& mass) {
  const auto mistakes = form_mistakes<6>(mass, "the mass");
  if (!mistakes.empty()) return mistakes;
  constexpr double slip = 1e-3;
  const Mat6 plane = full_mass(plane_mass(mass));
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      if (std::abs(mass(i, j) - plane(i, j)) <= slip * std::sqrt(mass(i, i) * mass(j, j))) continue;
      return {
          fmt::format("the mass is not that of a plane section, which moves with the directors "
                      "of its plane: entry ({}, {}) is {:.6g}, by the others it must be {:.6g}",
                      i + 1, j + 1, mass(i, j), plane(i, j))};
    }
  }
  return mass_mistakes(plane_mass(mass));
}

}  // namespace culm::material
