/// Elements that know a faster way to what batches need their gradient for.
#pragma once

#include <culm/mechanics/element.hpp>

namespace culm {

/// An element whose gradient is sparse, but not in its slots. It offers the products themselves.
template <class E>
concept HasSlotProducts = requires(const Slots<E::num_slots>& q, const Vec<E::num_strains>& S,
                                   const RowMat<E::num_strains, E::num_strains>& C, double factor,
                                   Slots<E::num_slots>& f,
                                   RowMat<3 * E::num_slots, 3 * E::num_slots>& K) {
  // f += B(q) S, one column per slot
  { E::add_force(q, S, f) }
  noexcept->std::same_as<void>;
  // K += factor B(q_mid) C B(q_next)^T, rows and columns 3 slot + component; C is row-major or,
  // if symmetric, either
  { E::add_stiffness(q, q, C, factor, K) }
  noexcept->std::same_as<void>;
};

}  // namespace culm
