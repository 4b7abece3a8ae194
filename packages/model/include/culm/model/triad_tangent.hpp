/// The part of a tangent between triads that comes from scalars between slots and from forces on
/// slots.
#pragma once

#include <culm/model/projection.hpp>

#include <array>

namespace culm::model {

/// K += P_theta^T (A x I3) P_next + theta sum_s [f_s][arm_s,next] for N triads that turn: what
/// NullSpace::add_pairs and add_turning add to all pairs of nodes, several times faster.
/// @param scalars  A, symmetric @param slot_force  f, one column per slot
template <int N>
void add_triad_tangent(const SlotMatrix<4 * N>& scalars, const Slots<4 * N>& slot_force,
                       const std::array<Arms<4>, N>& arms_theta,
                       const std::array<Arms<4>, N>& arms_next, double theta,
                       RowMat<6 * N, 6 * N>& K) noexcept;

}  // namespace culm::model
