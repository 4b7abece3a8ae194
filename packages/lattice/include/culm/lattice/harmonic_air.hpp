/// What air does in small motions exp(s t) about a steady flow.
#pragma once

#include <culm/lattice/lattice.hpp>

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace culm::lattice {

/// Q(s): minus the forces by the motions, along them. Circulations follow at once, and rows of the
/// wake with their delays.
Eigen::MatrixXcd harmonic_air(const SmallMotions& small, std::complex<double> s);

/// The same as states, for motions that decay as well, which no wake remembers for ever:
///   Q(s) = Q(0) + s damping + s^2 mass + sum of f(s) stiffness of all lags, f(s) = s T / (1 + s T)
/// @source Roger, Airplane math modeling methods for active control design, AGARD-CP-228, 1977
struct LaggedAir {
  /// What grows with a time T.
  struct Lag {
    double time = 0.0;  ///< T [s]
    Eigen::MatrixXd stiffness;
  };
  Eigen::MatrixXd damping, mass;
  std::vector<Lag> lags;  ///< by falling times; none without wind

  /// Q(s) - Q(0).
  Eigen::MatrixXcd at(std::complex<double> s) const;
};

/// By least squares over motions that neither grow nor decay, up to a reduced frequency
/// w c / 2 U of 2, or half a radian per panel where panels are too long for that.
LaggedAir fit_lags(const SmallMotions& small);

}  // namespace culm::lattice
