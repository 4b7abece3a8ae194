/// How much of the square of the hourglass displacement an enhanced element may feel.
#pragma once

#include <culm/material/layup.hpp>

namespace culm::shell {

/// Factors c1, c2 <= 1 on the mean square of the hourglass vector in the membrane strains 11
/// and 22.
///
/// Enhanced membrane strains take the shear energy from the hourglass mode of a parallelogram and
/// leave it the bending energy of slender fibres, V/3 λ |h|^2 at the least, while compression along
/// the sides draws V/3 (c1 S^11 + c2 S^22) |h|^2 from it. With these factors the mode is stable as
/// long as the material itself is, and up to a strain of 0.2, half of λ kept for each side:
///   c_i = min(1, λ / (2 |G^i|^2 s_i)),
/// s_i the compression along the normal of a side at which the wall in its plane shears off, or
/// that of this strain. Walls with layers for large strains have no bound that stays: 0 for them.
///
/// @param half_sides  vectors from the centre to the middles of the sides ξ = 1 and η = 1, as
///   columns, along axes 1, 2 of the layup [m]
/// @source theory page on shells, section on the hourglass mode
Vec<2> hourglass_factors(const Mat<2, 2>& half_sides, const material::Layup& layup);

}  // namespace culm::shell
