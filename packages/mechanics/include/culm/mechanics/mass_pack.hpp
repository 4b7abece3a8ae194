/// Rigid bodies side by side.
#pragma once

#include <culm/mechanics/pack.hpp>

namespace culm {

/// Masses between the slots of single triads: the entries (s, t) of [[m, S^T], [S, J]] on and above
/// the diagonal, by rows. @source formulation 1.2, eq. (1.1)
using MassPack = Packs<10>;

/// Takes the masses of an item to a lane.
void set_mass(const SlotMatrix<4>& mass, int lane, MassPack& masses);

/// The force M a with a = inertia (q_next - q_prev) + offset and its derivative, of triads that are
/// at no lever. @param sum  without tangent only the residual is written
void evaluate_masses(const MassPack& masses, const PackMotion<1>& motion, const Stencil& stencil,
                     bool with_tangent, PackSum<1>& sum);

}  // namespace culm
