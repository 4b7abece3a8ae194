/// Strains that a beam does without, held by constraints.
#pragma once

#include <culm/beam/director_beam.hpp>
#include <culm/model/constraint.hpp>

#include <array>
#include <string>

namespace culm::beam {

/// What is held: nothing of it costs energy, its forces are multipliers.
struct HeldStrains {
  bool shear_and_extension = false;
  bool torsion = false;
};

/// How the centres of a section shear and stretch as it bends without force, Γ = -D K with
///   D = C_ΓΓ^-1 C_ΓK , shape (3, 3) [m],
/// from the section stiffness C. Of an isotropic section D holds the places of tension and shear
/// centre. Where C_ΓΓ is singular, D is the smallest one that solves C_ΓΓ D = C_ΓK.
Mat3 centre_coupling(const Mat6& stiffness);

/// Stiffness of a section without shear and extension: no force resultant deforms it, so that with
/// the compliance of its moments alone
///   W = min_Γ 1/2 (Γ, K) . C (Γ, K) = 1/2 K . (C_KK - C_KΓ D) K .
/// This is the limit of C_ΓΓ -> inf with D and the compliance against moments as they are; it does
/// not depend on where in the section the axis runs. Rows and columns of Γ are zero.
Mat6 without_shear_and_extension(const Mat6& stiffness);

/// The strains of an element that are held at its points, one row each:
///   Γ + D K = 0 (shear and extension) with D of each point,  K3 = 0 (torsion),
/// all against the reference. Without torsion, K3 is left out of D K.
/// @param nodes      numbers in the model
/// @param reference  their slots, free of stress
template <int Order>
model::Constraint hold_strains(const std::string& name, HeldStrains held,
                               const DirectorBeam<Order>& element,
                               const std::array<int, Order + 1>& nodes,
                               const typename DirectorBeam<Order>::Nodes& reference);

}  // namespace culm::beam
