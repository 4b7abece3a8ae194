/// Triads side by side.
#pragma once

#include <culm/mechanics/pack.hpp>

namespace culm {

/// Moves positions by u[0..2] and turns triads by u[3..5], as exp_rotation and polar_correction do
/// with one. @param slots  x, d1, d2, d3 of each
void move_triads(const Packs<6>& u, Packs<12>& slots);

/// The u that takes triads from one place to another, as log_rotation finds it.
void find_motions(const Packs<12>& from, const Packs<12>& to, Packs<6>& u);

/// The rates of u that belong to velocities of the slots, omega = 1/2 sum_i d_i x w_i.
/// @source formulation 1.1
void find_rates(const Packs<12>& slots, const Packs<12>& velocities, Packs<6>& rates);

}  // namespace culm
