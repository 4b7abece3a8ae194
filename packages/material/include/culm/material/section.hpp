/// The cross-section of a beam: what it resists with, what it weighs, what it looks like.
#pragma once

#include <culm/material/fibres.hpp>
#include <culm/material/uniaxial_plasticity.hpp>
#include <culm/math/types.hpp>

#include <string>
#include <vector>

namespace culm::material {

/// Properties per length, about the axis of the beam (the origin of the section axes d1, d2).
struct Section {
  /// Symmetric, conjugate to (Γ1, Γ2, Γ3, K1, K2, K3), eq. (1.9) [N, N m, N m^2]
  Mat6 stiffness = Mat6::Zero();
  /// Symmetric, on the slots (x, d1, d2): int rho (1, xi1, xi2) (1, xi1, xi2)^T, eq. (1.10)
  /// [kg/m, kg, kg m]
  Mat3 mass = Mat3::Zero();
  /// Outer loop in (xi1, xi2), counter-clockwise, for pictures only; empty when unknown [m]
  std::vector<Vec<2>> outline;
  /// Coefficient of thermal expansion, the same all over the section [1/K]
  double expansion = 0.0;
  /// What it is made of where it can yield, and how; none of a section that is elastic. Their
  /// stiffness in stretch and bending is that of `stiffness`.
  std::vector<Fibre> fibres = {};
  FibrePattern pattern = {};
  UniaxialPlasticity plasticity = {};
  /// Where its own origin and axes lie, see place() [m, rad].
  Vec<2> offset = Vec<2>::Zero();
  double angle = 0.0;
};

/// The independent entries of eq. (1.9), axes d1 and d2 through the reference point.
struct StiffnessValues {
  double EA = 0.0;    ///< int E [N]
  double GA1 = 0.0;   ///< k1 int G [N]
  double GA2 = 0.0;   ///< k2 int G [N]
  double EI1 = 0.0;   ///< int E xi2^2 [N m^2]
  double EI2 = 0.0;   ///< int E xi1^2 [N m^2]
  double GIp = 0.0;   ///< St. Venant torsion stiffness [N m^2]
  double ES1 = 0.0;   ///< int E xi2 [N m]
  double ES2 = 0.0;   ///< int E xi1 [N m]
  double GS1 = 0.0;   ///< int G xi2 [N m]
  double GS2 = 0.0;   ///< int G xi1 [N m]
  double EI12 = 0.0;  ///< int E xi1 xi2 [N m^2]
};

/// The independent entries of eq. (1.10).
struct MassValues {
  double rhoA = 0.0;    ///< int rho [kg/m]
  double rhoI1 = 0.0;   ///< int rho xi2^2 [kg m]
  double rhoI2 = 0.0;   ///< int rho xi1^2 [kg m]
  double rhoS1 = 0.0;   ///< int rho xi2 [kg]
  double rhoS2 = 0.0;   ///< int rho xi1 [kg]
  double rhoI12 = 0.0;  ///< int rho xi1 xi2 [kg m]
};

/// Eq. (1.9)
Mat6 stiffness_matrix(const StiffnessValues& values);
/// Eq. (1.10)
Mat3 mass_matrix(const MassValues& values);

/// The mass as a 6x6 matrix, kinetic energy per length 1/2 (v, w) . M (v, w) with the velocity v of
/// the origin and the angular velocity w along d1, d2, d3: (m 1, -m [c]; m [c], J) of the centre c
/// of mass and the moments of inertia J about the origin. [kg/m, kg, kg m]
Mat6 full_mass(const Mat3& mass);
/// The other way round. @pre full_mass_mistakes(mass) is empty
Mat3 plane_mass(const Mat6& mass);

/// The mass whose part about the centre of mass is taken `factor` times: 0 leaves the mass at its
/// centre, with the couplings that belong to it. Positive semidefinite if `mass` is.
Mat3 with_rotary_inertia(const Mat3& mass, double factor);

/// The section whose own axes are turned by `angle` [rad] about d3 (positive from d1 to d2), seen
/// in the axes of the beam.
Section rotated(const Section& section, double angle);

/// The section whose own origin lies at `offset` (xi1, xi2) [m] from the axis of the beam.
Section shifted(const Section& section, const Vec<2>& offset);

/// The section turned by `angle` about its own origin, which is then moved to `offset`.
Section placed(const Section& section, double angle, const Vec<2>& offset);

/// (1 - t) a + t b of what both are about their own origins and axes, and of where these lie: what
/// bends by itself is not stiffened by what moves its axis. Where both yield, fibres are joined by
/// place and area, and the stiffness in stretch and bending is theirs. @pre the same pattern of
/// fibres in both. Outlines are joined point by point if they have the same number of points,
/// otherwise the nearer one is taken.
Section interpolate(const Section& a, const Section& b, double t);

/// What makes a stiffness or a mass impossible, one sentence each; empty if nothing does. Both
/// must be symmetric and positive semidefinite, the stiffness not zero.
std::vector<std::string> stiffness_mistakes(const Mat6& stiffness);
std::vector<std::string> mass_mistakes(const Mat3& mass);
/// A full mass must be that of a plane section as well, the only one that moves with the directors
/// of its plane: centre in the plane, J33 = J11 + J22, J13 = J23 = 0; to the 1e-3 that programs for
/// cross-sections leave of these rules.
std::vector<std::string> full_mass_mistakes(const Mat6& mass);

}  // namespace culm::material
