/// The laws every load on nodes obeys, as one typed test suite. A test file brings them all by:
///
///     INSTANTIATE_TYPED_TEST_SUITE_P(Tip, LoadContract, testing::Types<TipForceCase>);
///
/// where the case says how to make the load:
///
///     struct TipForceCase {
///       static constexpr int num_nodes = 1;
///       static constexpr bool follows = false;  // turns with the nodes
///       static std::unique_ptr<model::Batch> make(const model::NodeTable& nodes,
///                                                 const model::Amplitude& amplitude);
///       // force, and moment about the origin, at amplitude 1
///       static Resultant resultant(const model::Coordinates& q);
///     };
///
/// Nodes 0, 1, … have random positions and triads, or what `node_kind` of the case says (kind_of).
/// @source formulation 3, 8.2
#pragma once

#include <culm/model/amplitude.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace culm::kit {

/// Force [N] and moment about the origin [N m].
struct Resultant {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};

/// What forces on slots amount to: their power in the rigid motions of the configuration.
inline Resultant resultant_of(const Eigen::VectorXd& slot_forces, const model::Coordinates& q) {
  Resultant total;
  for (int slot = 0; slot < static_cast<int>(q.size()) / 3; ++slot) {
    const Vec3 f = slot_forces.segment<3>(3 * slot);
    if (slot % 4 == 0) total.force += f;
    total.moment += skew(Eigen::Map<const Vec3>(q.data() + 3 * slot)) * f;
  }
  return total;
}

template <class Case>
class LoadContract : public testing::Test {
 protected:
  static constexpr int num_nodes = Case::num_nodes;

  static void fill(model::Model& model, bool with_slave,
                   const model::Amplitude& amplitude = model::Amplitude::constant()) {
    for (int node = 0; node < num_nodes; ++node) {
      add_random_node(model.nodes(), kind_of<Case>(node), 10 + node);
    }
    model.add_load(Case::make(model.nodes(), amplitude));
    if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(random_node(20)));
  }
  static std::string effect() {
    model::Model model;
    fill(model, false);
    return model.batches().front()->effect().title();
  }

  /// External forces on all slots.
  static Eigen::VectorXd slot_forces(const model::State& state, const Stencil& stencil,
                                     const model::Amplitude& amplitude) {
    model::Model model;
    fill(model, false, amplitude);
    model.freeze(model::Form::multipliers);
    DenseAssembly dense(model);
    model::State full = model.initial_state();
    full.time_prev = state.time_prev;
    full.time = state.time;
    full.prev = state.prev;
    full.next = state.next;
    return -node_rows(model, dense.residual(full, stencil, {find_batch(model, effect())}))
                .head(12 * num_nodes);
  }
  static model::State state(int seed) {
    model::Model model;
    fill(model, false);
    model.freeze(model::Form::null_space);
    return random_state(model, seed);
  }
  static Resultant resultant(const model::Coordinates& q) {
    model::State state;
    state.prev = state.next = q;
    return resultant_of(slot_forces(state, Stencil::statics(), model::Amplitude::constant()), q);
  }

  static constexpr double round_off = 1e-13;  // some tens of operations with numbers up to 10
};

TYPED_TEST_SUITE_P(LoadContract);

TYPED_TEST_P(LoadContract, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    expect_tangent_is_derivative([&](model::Model& model) { this->fill(model, with_slave); },
                                 this->effect());
  }
}

TYPED_TEST_P(LoadContract, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    expect_residual_is_projected([&](model::Model& model) { this->fill(model, with_slave); },
                                 this->effect());
  }
}

// Also at the mean of two triads, whose directors are shorter than one: momentum balance.
TYPED_TEST_P(LoadContract, ForceAndMomentAreThoseAskedFor) {
  const model::State state = this->state(5);
  for (const Stencil& stencil : law_stencils) {
    const model::Coordinates q = at_theta(state, stencil.theta);
    const Resultant found =
        resultant_of(this->slot_forces(state, stencil, model::Amplitude::constant()), q);
    const Resultant expected = TypeParam::resultant(q);
    EXPECT_LT((found.force - expected.force).norm(), this->round_off);
    EXPECT_LT((found.moment - expected.moment).norm(), this->round_off);
  }
}

// A pure rotation about the origin turns the whole load, or nothing but the points it acts on.
TYPED_TEST_P(LoadContract, TurnsWithTheBodyOnlyIfItFollows) {
  const model::Coordinates q = this->state(5).next;
  const Mat3 R = exp_rotation(Vec3(0.7, -0.4, 1.1));
  model::Coordinates turned = q;
  for (int node = 0; node < TypeParam::num_nodes; ++node) {
    auto slots = model::NodeTable::slots(turned, node);
    slots = (R * slots).eval();
  }
  const Resultant before = this->resultant(q);
  const Resultant after = this->resultant(turned);
  const Mat3 expected = TypeParam::follows ? R : Mat3::Identity();
  EXPECT_LT((after.force - expected * before.force).norm(), this->round_off);
  const bool couple = before.force.norm() < this->round_off;
  if (TypeParam::follows || couple) {
    EXPECT_LT((after.moment - expected * before.moment).norm(), this->round_off);
  }
  EXPECT_GT(before.force.norm() + before.moment.norm(), 0.1);
}

TYPED_TEST_P(LoadContract, ActsWithTheAmplitudeAtTheta) {
  const model::State state = this->state(5);  // from time 0.3 to 0.7
  const auto square = model::Amplitude::of_time([](double t) { return t * t; });
  for (const auto& [stencil, factor] :
       {std::pair(Stencil::statics(), 0.49), std::pair(Stencil::midpoint(0.4), 0.25)}) {
    const Eigen::VectorXd full = this->slot_forces(state, stencil, model::Amplitude::constant());
    const Eigen::VectorXd scaled = this->slot_forces(state, stencil, square);
    EXPECT_LT(largest(scaled - factor * full), this->round_off);
  }
}

TYPED_TEST_P(LoadContract, AssembleAllocatesNothing) {
  expect_no_allocation([&](model::Model& model) { this->fill(model, true); }, this->effect());
}

TYPED_TEST_P(LoadContract, AttemptsLeaveNoTrace) {
  expect_attempts_leave_no_trace([&](model::Model& model) { this->fill(model, true); },
                                 this->effect());
}

REGISTER_TYPED_TEST_SUITE_P(LoadContract, TangentIsDerivativeOfResidual,
                            NullSpaceResidualIsProjected, ForceAndMomentAreThoseAskedFor,
                            TurnsWithTheBodyOnlyIfItFollows, ActsWithTheAmplitudeAtTheta,
                            AssembleAllocatesNothing, AttemptsLeaveNoTrace);

}  // namespace culm::kit
