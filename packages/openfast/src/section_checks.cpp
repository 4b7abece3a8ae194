#include "section_checks.hpp"

#include <culm/base/error.hpp>

#include "headings.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::openfast {

namespace {

// Files have six or seven digits.
constexpr double slip = 1e-5;

struct Check {
  const BeamDynBlade& blade;
  std::size_t station;
  const char* what;

  Where where() const {
    return {blade.path.string(), blade.stations[station].line,
            fmt::format("station {}, {}", station + 1, what)};
  }
};

// The largest difference of two entries that should be equal, over the geometric mean of their
// diagonal entries: the measure that does not depend on units.
double asymmetry(const Mat6& matrix, const Check& check) {
  double largest = 0.0;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const double scale = std::sqrt(std::abs(matrix(i, i) * matrix(j, j)));
      const double difference = std::abs(matrix(i, j) - matrix(j, i));
      if (difference > slip * scale) {
        throw InputError(check.where(),
                         fmt::format("must be symmetric, but entries ({0}, {1}) and ({1}, {0}) are "
                                     "{2:g} and {3:g}",
                                     j + 1, i + 1, matrix(j, i), matrix(i, j)));
      }
      if (difference > 0.0) largest = std::max(largest, difference / scale);
    }
  }
  return largest;
}

// The smallest eigenvalue of the matrix whose diagonal is scaled to one.
double definiteness(const Mat6& matrix, const Check& check) {
  for (int i = 0; i < 6; ++i) {
    if (!(matrix(i, i) > 0.0)) {
      const bool is_zero = matrix.isZero(0.0);
      throw InputError(
          check.where(),
          is_zero ? std::string("must be positive definite, but is zero: put in what the section "
                                "has, or as little of it as does no harm")
                  : fmt::format("must be positive definite, but entry ({0}, {0}) is {1:g}", i + 1,
                                matrix(i, i)));
    }
  }
  const Vec6 scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Mat6 scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const double smallest =
      Eigen::SelfAdjointEigenSolver<Mat6>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
  if (!(smallest > 0.0)) {
    throw InputError(check.where(), fmt::format("must be positive definite, but the smallest "
                                                "eigenvalue, diagonal scaled to 1, is {:.3g}",
                                                smallest));
  }
  return smallest;
}

// What the mass of a plane section with these values would be.
Mat6 plane_mass(const Mat6& given) {
  const double m = given(0, 0);
  const double mx = -given(2, 4);
  const double my = given(2, 3);
  Mat6 mass = Mat6::Zero();
  mass.diagonal() << m, m, m, given(3, 3), given(4, 4), given(3, 3) + given(4, 4);
  mass(0, 5) = -my;
  mass(1, 5) = mx;
  mass(2, 3) = my;
  mass(2, 4) = -mx;
  mass(3, 4) = given(3, 4);
  return mass.selfadjointView<Eigen::Upper>();
}

void check_plane(const BladeStation& station, const Check& check, Report& report) {
  const Mat6& mass = station.mass;
  const Mat6 plane = plane_mass(mass);
  int row = 0;
  int column = 0;
  const Vec6 scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Mat6 difference = scale.asDiagonal() * (mass - plane) * scale.asDiagonal();
  constexpr double tolerance = 1e-3;  // what preprocessors leave of the rule
  if (difference.cwiseAbs().maxCoeff(&row, &column) <= tolerance) return;
  if (std::abs(mass(3, 3) - mass(4, 4) - mass(5, 5)) <= tolerance * mass(3, 3) &&
      station.stiffness(0, 0) > station.stiffness(2, 2)) {
    throw InputError(
        check.where(),
        "the first axis is along the blade, as in files from before BeamDyn turned its axes: entry "
        "(4, 4) is the sum of (5, 5) and (6, 6), which (6, 6) must be of (4, 4) and (5, 5), and "
        "the first stiffness is above the third. "
        "Try: rows and columns in the order shear x, shear y, stretch, bending about x, about y, "
        "twist");
  }
  report.add(
      unknown,
      fmt::format("{}: not that of a plane section: entry ({}, {}) is {:g}, by the others it "
                  "is {:g}, which is taken",
                  to_string(check.where()), row + 1, column + 1, mass(row, column),
                  plane(row, column)));
}

}  // namespace

void check_stations(BeamDynBlade& blade, Report& report) {
  double largest = 0.0;
  double stiffness = 1.0;
  double mass = 1.0;
  for (std::size_t i = 0; i < blade.stations.size(); ++i) {
    BladeStation& station = blade.stations[i];
    const Check of_stiffness{blade, i, "stiffness"};
    const Check of_mass{blade, i, "mass"};
    largest = std::max(
        {largest, asymmetry(station.stiffness, of_stiffness), asymmetry(station.mass, of_mass)});
    station.stiffness = 0.5 * (station.stiffness + station.stiffness.transpose()).eval();
    station.mass = 0.5 * (station.mass + station.mass.transpose()).eval();
    stiffness = std::min(stiffness, definiteness(station.stiffness, of_stiffness));
    mass = std::min(mass, definiteness(station.mass, of_mass));
    check_plane(station, of_mass, report);
  }
  report.add(checked, fmt::format("{} matrices of stiffness and of mass: symmetric (largest "
                                  "difference {:.1e}) and positive definite",
                                  blade.stations.size(), largest));
  report.add(checked, fmt::format("smallest eigenvalue, diagonals scaled to 1: stiffness {:.3g}, "
                                  "mass {:.3g}",
                                  stiffness, mass));
}

}  // namespace culm::openfast
