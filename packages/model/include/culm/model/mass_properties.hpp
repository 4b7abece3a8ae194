/// Mass, centre of mass and inertia of structures.
#pragma once

#include <culm/model/model.hpp>

#include <vector>

namespace culm::model {

/// Of a structure, with the masses on its nodes, or of several.
struct MassProperties {
  double mass = 0.0;           ///< [kg]
  Vec3 first = Vec3::Zero();   ///< sum of m x [kg m]
  Mat3 second = Mat3::Zero();  ///< sum of m x x^T about the origin [kg m^2]

  MassProperties& operator+=(const MassProperties& other);
  /// Centre of mass [m]. @pre mass > 0
  Vec3 centre() const { return first / mass; }
  /// Inertia tensor about the centre of mass [kg m^2]. @pre mass > 0
  Mat3 inertia() const;
};

/// Of each structure, in their order, at a configuration. Exact for the mass matrices of the model:
/// m = 1^T M 1, m x_c = 1^T M x, sum m x x^T = sum_s q_s (M q)_s^T. @source formulation 1.2
std::vector<MassProperties> mass_properties(const Model& model, const Coordinates& q);

}  // namespace culm::model
