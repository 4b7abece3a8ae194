/// Elements whose law has unknowns of its own.
#pragma once

#include <culm/mechanics/element.hpp>

namespace culm {

/// An element with internal variables: parameters that its law solves for, point by point, and that
/// it remembers over the steps. Everything else is as in Element. A batch keeps two vectors per
/// point: of the last accepted step (zero before the first), and of the current iterate, which
/// starts a step as a copy of the first and replaces it when the step is accepted.
template <class E>
concept ElementWithInternals = requires(const E& e, int point, const Vec<E::num_strains>& y,
                                        const Stencil& stencil, const Vec<E::num_internals>& prev,
                                        Vec<E::num_internals>& next,
                                        Response<E::num_strains>& response) {
  { E::num_internals } -> std::convertible_to<int>;  // per point

  // `next`: a first guess on entry, the solution on return. Stress and tangent are those after
  // elimination: the internals do no work, S . (y_next - y_prev) = W_next - W_prev.
  { e.respond(point, y, y, prev, stencil, next, response) }
  noexcept->std::same_as<Verdict>;
  { e.energy(point, y, prev) }
  noexcept->std::convertible_to<double>;
};

}  // namespace culm
