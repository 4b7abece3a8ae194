/// Mass properties of rigid bodies in director coordinates.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/node.hpp>

#include <string>
#include <vector>

namespace culm::body {

/// Mass properties about the centre of mass, in the body's axes.
struct Inertia {
  double mass = 0.0;           ///< [kg]
  Vec3 centre = Vec3::Zero();  ///< centre of mass from the node, in its directors [m]
  Mat3 tensor = Mat3::Zero();  ///< inertia tensor about the centre of mass [kg m^2]
};

/// Second moments int rho xi xi^T about the centre of mass from the inertia tensor,
/// J = 1/2 tr(Theta) 1 - Theta. @source formulation 1.2, eq. (1.2)
Mat3 euler_tensor(const Mat3& inertia_tensor);

/// [[m, S^T], [S, J]] on the slots (x, d1, d2, d3), eq. (1.1), (1.3) [kg, kg m, kg m^2]
SlotMatrix<4> mass_matrix(const Inertia& inertia);

/// What makes the properties impossible, one sentence each; empty if nothing does.
std::vector<std::string> mistakes(const Inertia& inertia);

/// Solid bodies of constant density about their own centre, d3 along their axis.
Inertia solid_box(const Vec3& size, double density);
Inertia solid_cylinder(double radius, double height, double density);
Inertia solid_sphere(double radius, double density);
/// The node is at the centre of the base, the apex at height along d3.
Inertia solid_cone(double radius, double height, double density);

}  // namespace culm::body
