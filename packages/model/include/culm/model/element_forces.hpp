/// What one element adds to residual and tangent: by its stresses, by its branches of relaxation
/// and by its inertia.
#pragma once

#include <culm/math/small_product.hpp>
#include <culm/model/element_contribution.hpp>
#include <culm/model/element_motion.hpp>
#include <culm/model/element_store.hpp>
#include <culm/model/inertia.hpp>
#include <culm/model/point_laws.hpp>
#include <culm/model/projection.hpp>

namespace culm::model {

/// An element in a step, in the unknowns of a space. @source formulation 5.2
template <class Space, BatchElement E>
class ElementForces {
 public:
  static constexpr int N = E::num_nodes;
  static constexpr int S = E::num_slots;
  static constexpr int M = E::num_strains;
  using Item = typename ElementStore<E>::Item;
  using Strain = Vec<M>;
  using Motion = ElementMotion<E>;
  using Contribution = ElementContribution<Space, E>;
  using Taken = typename PointLaws<E>::Taken;

  /// All must live as long. @param laws  of the batch @param first_point  of the element there
  ElementForces(const NodeTable& table, const Item& item, const Motion& motion, PointLaws<E>& laws,
                std::size_t first_point)
      : table_(table),
        element_(item.element),
        nodes_(item.nodes),
        motion_(motion),
        laws_(laws),
        first_point_(first_point) {}

  /// B(q_theta)^T S and its derivative. @param stencil  damped
  /// @param predicted  stresses that the derivative is for, by point; nullptr: those at hand
  /// @param taken  where it is wanted, += what the step takes
  Verdict add_stress(const Stencil& stencil, const Strain* predicted, Taken* taken,
                     Contribution& c) const {
    if constexpr (on_unknowns) {
      return add_stress_to_unknowns(stencil, predicted, taken, c);
    } else {
      return add_stress_to_slots(stencil, predicted, taken, c);
    }
  }

  /// R C_k R^T of a branch k at the end of the step: its part of the tangent.
  void add_branch(std::size_t branch, Contribution& c) const {
    for (int p = 0; p < E::num_points; ++p) {
      const RowMat<M, M> C = laws_.branch_stiffness(element_, p, branch);
      if constexpr (on_unknowns) {
        E::add_stiffness(motion_.next, motion_.next, C, 1.0, c.tangent);
      } else {
        Gradient<S, M> B;
        RowMat<W, M> R, RC;
        element_.gradient(p, motion_.next, B);
        reduce(B, motion_.arms_next, R);
        multiply(R, C, RC);
        const RowMat<M, W> R_transposed = R.transpose();
        multiply_add(RC, R_transposed, c.tangent);
      }
    }
    if constexpr (on_unknowns) c.turn_tangent(motion_, table_, nodes_);
  }

  /// M a and its derivative, with a = inertia (q_next - q_prev) + offset. @param mass  M, scalars
  void add_inertia(const SlotMatrix<S>& mass, const State& state, const Stencil& stencil,
                   Contribution& c) const {
    Slots<S> force = gather_slots<K>(nodes_, state.acceleration_offset);
    force += stencil.inertia *
             (motion_.next -
              (stencil.theta == 1.0 ? gather_slots<K>(nodes_, state.prev) : motion_.prev));
    force = inertia_force<S>(mass, force);
    c.add_slot_force(force, motion_);
    if (!c.with_tangent) return;
    c.slot_force += force;
    c.scalars += stencil.inertia * mass;
  }

 private:
  static constexpr int K = slots_of(E::node_kind);  // slots per node
  static constexpr int W = Space::width * N;
  // whether the element knows faster products for these unknowns
  static constexpr bool on_unknowns = ActsOnUnknowns<E> && Space::form == Form::null_space;

  Verdict add_stress_to_slots(const Stencil& stencil, const Strain* predicted, Taken* taken,
                              Contribution& c) const {
    Verdict verdict = Verdict::ok;
    Strain y;
    Response<M> response;
    response.wants_tangent = c.with_tangent;
    Gradient<S, M> B;
    RowMat<W, M> R;
    for (int p = 0; p < E::num_points; ++p) {
      element_.strain(p, motion_.next, y);
      element_.gradient(p, motion_.mid, B);
      verdict = worse(verdict, laws_.respond(element_, p, at(p), y, stencil, response));
      reduce(B, motion_.arms_mid, R);
      c.residual.noalias() += R.lazyProduct(response.stress);
      if (taken) laws_.add_taken(element_, p, at(p), y, stencil, &response, *taken);
      if (!c.with_tangent) continue;

      const Strain& stress = predicted ? predicted[p] : response.stress;
      Eigen::Map<Vec<3 * S>>(c.slot_force.data()).noalias() += B.lazyProduct(stress);
      element_.add_curvature(p, stencil.theta * stress, c.scalars);
      RowMat<W, M> RD;
      laws_.with_tangent(element_, p, stencil, response, [&](const auto& C, double factor) {
        multiply(R, C, RD);
        RD *= factor;
      });
      if (stencil.theta != 1.0) {
        element_.gradient(p, motion_.next, B);
        reduce(B, motion_.arms_next, R);
      }
      const RowMat<M, W> R_next = R.transpose();
      multiply_add(RD, R_next, c.tangent);
    }
    return verdict;
  }

  Verdict add_stress_to_unknowns(const Stencil& stencil, const Strain* predicted, Taken* taken,
                                 Contribution& c) const {
    Verdict verdict = Verdict::ok;
    Strain y;
    Response<M> response;
    Slots<S> force = Slots<S>::Zero();
    for (int p = 0; p < E::num_points; ++p) {
      element_.strain(p, motion_.next, y);
      verdict = worse(verdict, laws_.respond(element_, p, at(p), y, stencil, response));
      E::add_force(motion_.mid, response.stress, force);
      if (taken) laws_.add_taken(element_, p, at(p), y, stencil, &response, *taken);
      if (!c.with_tangent) continue;
      const Strain& stress = predicted ? predicted[p] : response.stress;
      if (predicted) E::add_force(motion_.mid, stress, c.slot_force);
      element_.add_curvature(p, stencil.theta * stress, c.scalars);
      laws_.with_tangent(element_, p, stencil, response, [&](const auto& C, double factor) {
        E::add_stiffness(motion_.mid, motion_.next, C, factor, c.tangent);
      });
    }
    c.add_slot_force(force, motion_);
    if (!c.with_tangent) return verdict;
    if (!predicted) c.slot_force += force;
    c.turn_tangent(motion_, table_, nodes_);
    return verdict;
  }

  std::size_t at(int p) const { return first_point_ + static_cast<std::size_t>(p); }

  static void reduce(const Gradient<S, M>& B, const typename Motion::ItemArms& arms,
                     RowMat<W, M>& R) {
    for (int a = 0; a < N; ++a) {
      Space::reduce_rows(B.template middleRows<3 * K>(3 * K * a), arms[static_cast<std::size_t>(a)],
                         R.template middleRows<Space::width>(Space::width * a));
    }
  }

  const NodeTable& table_;
  const E& element_;
  const std::array<int, N>& nodes_;
  const Motion& motion_;
  PointLaws<E>& laws_;
  std::size_t first_point_;
};

}  // namespace culm::model
