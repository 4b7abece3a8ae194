/// What an element author provides, all of it.
///
/// Every strain measure of culm is a set of quadratic forms of the slots (formulation 0.3),
///   y_I(q) = 1/2 sum_ab A_I[a,b] q_a . q_b + sum_a b_I[a] . q_a + c_I,
/// so an element states its forms and the law that answers them, point by point. Projection to
/// unknowns, time stencil, geometric stiffness, stress extrapolation, energy and scatter are
/// written once, in ElementBatch (model).
#pragma once

#include <culm/mechanics/node.hpp>
#include <culm/mechanics/stencil.hpp>

#include <concepts>

namespace culm {

/// Gradient of M quadratic forms with respect to S slots: row 3 s + c holds the derivatives of all
/// forms by component c of slot s; shape (3 S, M). Linear in q.
template <int S, int M>
using Gradient = RowMat<3 * S, M>;

/// Answer of the law at one point. Quadrature weight included.
template <int M>
struct Response {
  Vec<M> stress;              ///< algorithmic stress conjugate to the forms, times weight
  RowMat<M, M> tangent;       ///< its derivative by the forms at the end of the step
  bool wants_tangent = true;  ///< if not, a law may leave it as it is
};

template <class E>
concept Element = requires(const E& e, int point, const Slots<E::num_slots>& q,
                           const Vec<E::num_strains>& y, const Stencil& stencil,
                           Vec<E::num_strains>& strain, Gradient<E::num_slots, E::num_strains>& B,
                           SlotMatrix<E::num_slots>& A, Response<E::num_strains>& response) {
  { E::node_kind } -> std::convertible_to<NodeKind>;  // one kind for all nodes of the element
  { E::num_nodes } -> std::convertible_to<int>;
  { E::num_slots } -> std::convertible_to<int>;    // num_nodes * slots_of(node_kind)
  { E::num_points } -> std::convertible_to<int>;   // quadrature points
  { E::num_strains } -> std::convertible_to<int>;  // forms per point

  // y(q) of a point; reference values subtracted
  { e.strain(point, q, strain) }
  noexcept->std::same_as<void>;
  // dy/dq of a point, linear in q; every entry is written
  { e.gradient(point, q, B) }
  noexcept->std::same_as<void>;
  // A += sum_I S_I A_I of a point
  { e.add_curvature(point, y, A) }
  noexcept->std::same_as<void>;
  // stress and tangent from the forms at both ends of the step
  { e.respond(point, y, y, stencil, response) }
  noexcept->std::same_as<Verdict>;
  // stored energy [J] of a point, weight included
  { e.energy(point, y) }
  noexcept->std::convertible_to<double>;
  // constant scalar mass matrix between slots [kg, kg m, kg m^2]
  { e.mass() }
  noexcept->std::convertible_to<SlotMatrix<E::num_slots>>;
};

/// An element whose law is linear: stress = C y with a constant, symmetric C of each point, weight
/// included. Stating it saves the copies that respond() makes.
template <class E>
concept HasStiffness = requires(const E& e, int point) {
  { e.stiffness(point) }
  noexcept->std::convertible_to<const RowMat<E::num_strains, E::num_strains>&>;
};

/// An element whose stress over a step does just what changes its stored energy, as long as the
/// strain of its law is the mean of both ends.
template <class E>
concept StressConserves = HasStiffness<E> || requires {
  requires E::stress_conserves;
};

/// An element that multiplies by its gradient faster than by the matrix that gradient() writes.
/// Stiffness stands in the six unknowns of each of its nodes: dx and dθ of a triad, with
/// dd_i = dθ x d_i for d_i of `mid` in rows and of `next` in columns; dx and dd of a shell node.
template <class E>
concept ActsOnUnknowns = requires(const Slots<E::num_slots>& q, const Vec<E::num_strains>& y,
                                  const RowMat<E::num_strains, E::num_strains>& C,
                                  Slots<E::num_slots>& f,
                                  RowMat<6 * E::num_nodes, 6 * E::num_nodes>& K) {
  { E::add_force(q, y, f) }
  noexcept->std::same_as<void>;  // f += B(q) y
  { E::add_stiffness(q, q, C, 1.0, K) }
  noexcept->std::same_as<void>;  // K += factor B(mid) C B(next)^T
};

/// An element that can show stress resultants, in the order of `E::resultant_names()`.
template <class E>
concept HasResultants = requires(const E& e, int point, const Vec<E::num_strains>& y) {
  { e.resultants(point, y) }
  noexcept->std::convertible_to<Vec<E::num_resultants>>;
};

}  // namespace culm
