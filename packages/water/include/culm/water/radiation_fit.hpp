/// Radiation of waves by states that follow the motion.
#pragma once

#include <culm/water/potential_body.hpp>

#include <complex>
#include <vector>

namespace culm::water {

/// Cummins' kernel as a sum of decaying oscillations, K(t) = sum 2 Re(R exp(p t)): what a body
/// radiates is sum 2 Re(R z) with dz/dt = p z + v for each pole, v the velocities of its motions.
struct RadiationModel {
  struct Term {
    std::complex<double> pole;                          ///< of negative real part [1/s]
    Eigen::Matrix<std::complex<double>, 6, 6> residue;  ///< symmetric
  };
  std::vector<Term> terms;
  double error = 0.0;    ///< of the fit, root of the mean squares over that of the data
  double creates = 0.0;  ///< most negative damping over the largest one; 0 if it only takes energy
  /// Constant damping that makes up for this, so that motion never gains energy.
  Mat6 extra = Mat6::Zero();

  /// Damping plus i omega times the added mass above that at infinite frequency, without `extra`.
  Eigen::Matrix<std::complex<double>, 6, 6> at(double frequency) const;
};

/// Poles and residues by vector fitting of damping + i omega (added mass - that at infinity), with
/// poles that all entries share. @param pairs  of complex poles, at least 1
/// @source Cummins (1962); Gustavsen and Semlyen (1999), IEEE Trans. Power Delivery 14
RadiationModel fit_radiation(const PotentialBody& body, int pairs);

}  // namespace culm::water
