/// An ideal fluid in a channel under a wall: the reference problem of added mass.
#pragma once

#include <culm/coupling/point_partner.hpp>

#include <Eigen/Core>

#include <memory>

namespace culm::coupling {

/// A channel of an incompressible fluid without friction, under a wall that moves along `normal`.
struct FlowChannel {
  double density;          ///< [kg/m^3]
  double height;           ///< of the fluid under the wall, to a floor or to the axis [m]
  double width;            ///< across [m]
  Eigen::Vector3d normal;  ///< of the wall, a unit vector
};

/// Its pressure on the points of a wall at equal distances in a row, the first and the last one a
/// distance away from the ends of the channel, where the pressure is zero:
///
///   f = -M a      M = rho b d sum_i mu_i s_i s_i^T      mu_i = L / (i pi tanh(i pi H / L))
///
/// with the sines s_i of the row, of length one, the distance d of the points and L = (n + 1) d.
/// Time steps are those of make_added_mass.
/// @source Causin, Gerbeau, Nobile, CMAME 194 (2005) 4506-4527, equation (12) and section 3
std::unique_ptr<PointModel> make_channel_flow(const FlowChannel& channel);

/// The masses of n points d apart with a channel under them, see make_channel_flow [kg].
Eigen::MatrixXd channel_masses(const FlowChannel& channel, int points, double distance);

}  // namespace culm::coupling
