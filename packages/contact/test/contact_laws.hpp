/// What all loads by contact owe, by cases of their own.
#pragma once

#include <Eigen/Geometry>
#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::contact {

using kit::effect;

/// Tangent, projection, no allocation, no trace of an attempt.
/// @param fill (model, case, with_slave) builds nodes and the load of a case under `effect`
/// @param cases of which the fourth has all that a kind of contact can do
template <class Cases, class Fill>
void expect_laws_of_batches(const Cases& cases, const Fill& fill) {
  for (const auto& data : cases) {
    SCOPED_TRACE(testing::Message() << "case " << &data - cases);
    for (const bool slave : {false, true}) {
      kit::expect_tangent_is_derivative([&](model::Model& m) { fill(m, data, slave); }, effect,
                                        3e-4);
    }
  }
  const auto make = [&](model::Model& m) { fill(m, cases[3], true); };
  kit::expect_residual_is_projected(make, effect);
  kit::expect_no_allocation(make, effect);
  kit::expect_attempts_leave_no_trace(make, effect);
}

/// A step of one contact and what it did.
struct ContactStep {
  Eigen::VectorXd r, prev, next;  ///< residual and slots at both ends
  double stored = 0.0;            ///< gain of stored energy
  model::StepWork work;
};

/// Work of a step is what is stored and what damping, friction and dissipation take, none of which
/// gives. @param visit (case, stencil, step) for what a kind of contact owes beside
template <class Cases, class Fill, class Visit>
void expect_work_is_accounted_for(const Cases& cases, const Fill& fill, const Visit& visit) {
  for (const auto& data : cases) {
    SCOPED_TRACE(testing::Message() << "case " << &data - cases);
    model::Model model;
    fill(model, data, false);
    model.freeze(model::Form::multipliers);
    const model::State state = kit::random_state(model, 3);
    kit::DenseAssembly dense(model);
    model::Batch* batch = kit::find_batch(model, effect);
    const auto slots = static_cast<Eigen::Index>(state.next.size());
    for (const Stencil& stencil : {Stencil::midpoint(0.4), Stencil{0.4, 0.5, 0.75}}) {
      ContactStep step;
      step.r = dense.residual(state, stencil, {batch}).head(slots);
      step.prev = Eigen::Map<const Eigen::VectorXd>(state.prev.data(), slots);
      step.next = Eigen::Map<const Eigen::VectorXd>(state.next.data(), slots);
      step.stored = batch->stored_energy(state.next) - batch->stored_energy(state.prev);
      step.work = batch->step_work(state, stencil);
      EXPECT_GT(step.r.norm(), 1e-3);
      EXPECT_NEAR(step.r.dot(step.next - step.prev),
                  step.stored + step.work.damping + step.work.dissipation,
                  1e-12 * (1.0 + std::abs(step.stored)));
      EXPECT_GE(step.work.damping, -1e-12);
      if constexpr (requires { data.friction; }) {
        EXPECT_GE(step.work.dissipation, -1e-12);
        if (data.friction.coefficient > 0.0) {
          EXPECT_GT(step.work.damping, 1e-3);
        }
      }
      visit(data, stencil, step);
    }
  }
}

/// Forces between nodes balance with those that come from outside.
inline void expect_momenta_balance(const ContactStep& step) {
  Vec3 force = step.work.force;
  Vec3 moment = step.work.moment;
  for (int s = 0; s < step.r.size() / 3; ++s) {
    const Vec3 f = step.r.segment<3>(3 * s);
    if (s % 4 == 0) force += f;
    moment += (0.5 * (step.prev.segment<3>(3 * s) + step.next.segment<3>(3 * s))).cross(f);
  }
  EXPECT_LT(force.norm(), 1e-12 * (1.0 + step.r.norm()));
  EXPECT_LT(moment.norm(), 1e-11 * (1.0 + step.r.norm()));
}

}  // namespace culm::contact
