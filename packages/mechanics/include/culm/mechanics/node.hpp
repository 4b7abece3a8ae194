/// Node kinds in director coordinates and their slots.
#pragma once

#include <culm/math/types.hpp>

#include <cstdint>

namespace culm {

/// A node carries 3-vectors called slots: a position and its directors.
enum class NodeKind : std::uint8_t {
  node6,   ///< position and one extensible director (shells): x, d
  node12,  ///< position and an orthonormal triad (beams, rigid bodies): x, d1, d2, d3
};

/// Number of slots of a node kind.
constexpr int slots_of(NodeKind kind) { return kind == NodeKind::node12 ? 4 : 2; }
/// Number of director coordinates of a node kind.
constexpr int coordinates_of(NodeKind kind) { return 3 * slots_of(kind); }

/// Slots of an item: one column per slot, node after node; shape (3, S). Unit m for positions,
/// 1 for directors. The columns of a node lie as its coordinates lie in memory.
template <int S>
using Slots = Mat<3, S>;

/// Scalars coupling slots, shape (S, S): the matrix A of a quadratic form, a mass matrix, a load
/// stiffness. The coordinate matrix is its Kronecker product with the 3x3 identity.
template <int S>
using SlotMatrix = Mat<S, S>;

}  // namespace culm
