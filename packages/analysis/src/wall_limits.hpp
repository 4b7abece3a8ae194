/// Stresses that a wall of a shell does not carry by itself, whatever its shape and supports.
#pragma once

#include <culm/assembly/system.hpp>

#include <limits>
#include <string>

namespace culm::analysis {

/// A factor of stress, and the wall that it makes unstable first.
struct WallLimit {
  double factor = std::numeric_limits<double>::infinity();  ///< signed; infinite where none does
  std::string structure;
  int cell = 0;
};

/// The nearest ones in both directions of the load.
struct WallLimits {
  WallLimit positive, negative;
};

/// Factors μ at which the wall of some cell has no stiffness left against waves that are short
/// beside its thickness. Such a wave u(n.x) + ζ v(n.x) feels the gradients alone,
///   int [1 ζ; ζ ζ^2] (A(n) + S_nn + μ ΔS_nn) dζ,   A_ab(n) = (a n) : C : (b n),
/// mostly in transverse shear, where A = G. What is right for longer waves ends there, and no mesh
/// resolves them. Stiffness and stress are those at the centres of the cells at `q`; ΔS is the
/// stress of the motion to first order. `q` and `motion` are up to date on all ranks. Collective.
/// @param motion  of all slots, as `q`
WallLimits find_wall_limits(const assembly::System& system, const model::Coordinates& q,
                            const model::Coordinates& motion);

}  // namespace culm::analysis
