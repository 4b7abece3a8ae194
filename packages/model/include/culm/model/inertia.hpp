/// Inertia of items with a constant scalar mass matrix between their slots.
#pragma once

#include <culm/mechanics/stencil.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/projection.hpp>

#include <Eigen/Geometry>

namespace culm::model {

/// Slot forces M a, shape (3, S). Slots are columns and the mass matrix is symmetric, so the
/// Kronecker product with 1 is a product from the right. @source formulation 1.2
template <int S>
Slots<S> inertia_force(const SlotMatrix<S>& mass, const Slots<S>& acceleration) {
  return acceleration * mass;
}

/// T = 1/2 v . M v of an item.
template <int S>
double kinetic_energy(const SlotMatrix<S>& mass, const Slots<S>& velocity) {
  return 0.5 * inertia_force(mass, velocity).cwiseProduct(velocity).sum();
}

/// Adds p = M v of an item: T = 1/2 v . p, L = sum of p over positions, J = sum_s q_s x p_s.
/// @tparam K slots per node, the first of which is the position. @source formulation 1.2, 4.6
template <int K, int S>
void add_item_momentum(const SlotMatrix<S>& mass, const Slots<S>& q, const Slots<S>& velocity,
                       Momentum& momentum) {
  const Slots<S> p = inertia_force(mass, velocity);
  momentum.kinetic_energy += 0.5 * p.cwiseProduct(velocity).sum();
  for (int s = 0; s < S; ++s) {
    if (s % K == 0) momentum.linear += p.col(s);
    const Vec3 slot = q.col(s);
    momentum.angular += slot.cross(Vec3(p.col(s)));
  }
}

}  // namespace culm::model
