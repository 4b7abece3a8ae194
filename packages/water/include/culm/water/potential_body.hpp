/// What potential flow says of a floating body, from files of WAMIT.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/math/types.hpp>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace culm::water {

/// Added mass and damping at a frequency. Motions: along x, y, z, about x, y, z.
struct Radiation {
  double frequency = 0.0;  ///< [rad/s]
  Mat6 added_mass = Mat6::Zero();
  Mat6 damping = Mat6::Zero();
};

/// Forces per amplitude of waves of one frequency, for each heading.
struct Excitation {
  double frequency = 0.0;                                         ///< [rad/s]
  std::vector<Eigen::Matrix<std::complex<double>, 6, 1>> forces;  ///< of cos(omega t) at the origin
};

/// Linear forces of the water, in SI units, about the origin of the files.
struct PotentialBody {
  Mat6 hydrostatics = Mat6::Zero();    ///< restoring forces per motion, without weight
  Mat6 infinite_mass = Mat6::Zero();   ///< added mass at infinite frequency
  std::vector<Radiation> radiation;    ///< by rising frequency, 0 and infinity excluded
  std::vector<double> headings;        ///< rising, of waves, counter-clockwise from x [rad]
  std::vector<Excitation> excitation;  ///< by rising frequency
};

/// How the numbers of the files become those in SI units.
struct WamitScale {
  double density = 0.0;  ///< of the water [kg/m^3]
  double gravity = 0.0;  ///< [m/s^2]
  double length = 1.0;   ///< ULEN [m]
};

/// Reads NAME.1, NAME.3, NAME.hst where `path` is that of NAME.1: added mass and damping by period,
/// infinite frequency at period 0, zero frequency at a negative one; forces of waves by period and
/// heading; hydrostatics. Throws InputError with file and line, or for `asking` where a file cannot
/// be read. @source WAMIT user manual, output files
PotentialBody read_wamit(const std::string& path, const WamitScale& scale, const Where& asking);

/// A heading as the files count it, by whole turns more or less; none if it lies outside of theirs.
std::optional<double> heading_in(const PotentialBody& body, double heading);

/// Forces per amplitude of waves of a frequency and heading, linear between those of the files.
/// @pre within their range
Eigen::Matrix<std::complex<double>, 6, 1> excitation_of(const PotentialBody& body, double frequency,
                                                        double heading);

}  // namespace culm::water
