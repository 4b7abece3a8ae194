#include <culm/beam/element_batches.hpp>

#include "beam_case.hpp"

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace culm::beam {
namespace {

using kit::effect;

/// Elements of a case, and on demand a master that the last node of all follows. @param sections
/// so many follow each other, where the case has more than one
template <class Case>
void fill(model::Model& model, bool with_slave, int num_elements = 1, int sections = 1) {
  using E = typename Case::Type;
  const auto reference = Case::reference();
  std::array<int, E::num_nodes> nodes{};
  for (int e = 0; e < num_elements; ++e) {
    for (int a = 0; a < E::num_nodes; ++a) {
      nodes[static_cast<std::size_t>(a)] =
          model.nodes().add(reference.template middleCols<4>(4 * a));
    }
    if constexpr (requires { Case::make(e); }) {
      model::elements<E>(model, effect).add(Case::make(e % sections), nodes);
    } else {
      model::elements<E>(model, effect).add(Case::make(), nodes);
    }
  }
  if (with_slave) {
    model.add_rigid_link("link", nodes.back(), model.nodes().add(kit::random_node(20)));
  }
}

/// What ElementBatch makes of the forms of an element.
template <class Case>
class ProjectedElement : public testing::Test {};

using Cases =
    testing::Types<DirectorBeamCase<1>, DirectorBeamCase<2>, DirectorBeamCase<3>, HelicalBeamCase>;
TYPED_TEST_SUITE(ProjectedElement, Cases);

TYPED_TEST(ProjectedElement, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    kit::expect_tangent_is_derivative(
        [&](model::Model& model) { fill<TypeParam>(model, with_slave); }, effect);
  }
}

TYPED_TEST(ProjectedElement, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    kit::expect_residual_is_projected(
        [&](model::Model& model) { fill<TypeParam>(model, with_slave); }, effect);
  }
}

// More than a pack of them, and not full packs.
TYPED_TEST(ProjectedElement, ResidualOfManyIsProjected) {
  kit::expect_residual_is_projected(
      [&](model::Model& model) { fill<TypeParam>(model, true, pack_lanes + 3); }, effect);
}

// The tangent of a stress that was extrapolated along an increment is that of the stress there, up
// to the square of the increment; in packs and one by one.
TYPED_TEST(ProjectedElement, ExtrapolatedStressIsOfFirstOrder) {
  for (const model::Form form : {model::Form::null_space, model::Form::multipliers}) {
    for (const Stencil& stencil : kit::law_stencils) {
      const auto error = [&](double size, bool extrapolates) {
        model::Model model;
        fill<TypeParam>(model, true, pack_lanes + 3);
        model.freeze(form);
        const std::vector<model::Batch*> tested = {kit::find_batch(model, effect)};
        kit::DenseAssembly dense(model);
        model::State state = kit::random_state(model, 3);
        model::Coordinates increment = state.velocity;
        for (double& number : increment) number *= size;
        dense.prepare(state, stencil);
        if (extrapolates) tested.front()->extrapolate(state, stencil, increment);
        for (std::size_t i = 0; i < increment.size(); ++i) state.next[i] += increment[i];
        const Eigen::MatrixXd found = dense.tangent(state, stencil, tested);
        dense.prepare(state, stencil);
        return kit::largest(found - dense.tangent(state, stencil, tested));
      };
      const double coarse = error(1e-3, true);
      EXPECT_NEAR(error(0.5e-3, true) / coarse, 0.25, 0.01);
      EXPECT_EQ(error(1e-3, false), 0.0);
    }
  }
}

// In the null-space form packs find them, with multipliers one element after the other does. Packs
// with the same sections share them.
TYPED_TEST(ProjectedElement, EnergyAndMomentumAreTheSameInBothForms) {
  struct Sums {
    double energy, taken, kinetic;
    model::Momentum momentum;
  };
  const auto expect_same = [](const Stencil& stencil, int sections) {
    const auto sums = [&](model::Form form) {
      model::Model model;
      fill<TypeParam>(model, false, 2 * pack_lanes + 3, sections);
      model.freeze(form);
      model::Batch* batch = kit::find_batch(model, effect);
      kit::DenseAssembly dense(model);
      const model::State state = kit::random_state(model, 3);
      dense.prepare(state, stencil);
      const model::StepWork work = batch->step_work(state, stencil);
      const auto& source = dynamic_cast<const model::MassSource&>(*batch);
      Sums found{batch->stored_energy(state.next),
                 work.damping + work.dissipation,
                 source.kinetic_energy(state.velocity),
                 {}};
      source.add_momentum(state.next, state.velocity, found.momentum);
      return found;
    };
    const Sums packs = sums(model::Form::null_space);
    const Sums each = sums(model::Form::multipliers);
    constexpr double rounding = 1e-13;
    EXPECT_NEAR(packs.energy / each.energy, 1.0, rounding);
    // only a step of time takes something
    if (stencil.step > 0.0) {
      EXPECT_NEAR(packs.taken, each.taken, rounding * each.energy);
    }
    const double kinetic = each.momentum.kinetic_energy;
    EXPECT_NEAR(packs.kinetic / kinetic, 1.0, rounding);
    EXPECT_NEAR(each.kinetic / kinetic, 1.0, rounding);
    EXPECT_GT(kinetic, 0.0);
    EXPECT_NEAR(packs.momentum.kinetic_energy / kinetic, 1.0, rounding);
    EXPECT_LT((packs.momentum.linear - each.momentum.linear).norm(),
              rounding * each.momentum.linear.norm());
    EXPECT_LT((packs.momentum.angular - each.momentum.angular).norm(),
              rounding * each.momentum.angular.norm());
  };
  for (const Stencil& stencil : kit::law_stencils) {
    expect_same(stencil, 1);
    expect_same(stencil, 5);
  }
}

// What a step takes comes from its last evaluation where that told it, and is the same where it did
// not: after one with the tangent, and before any.
TYPED_TEST(ProjectedElement, TakesWhatItsLastEvaluationTold) {
  model::Model model;
  fill<TypeParam>(model, false, 2 * pack_lanes + 3, 5);
  model.freeze(model::Form::null_space);
  model::Batch* batch = kit::find_batch(model, effect);
  kit::DenseAssembly dense(model);
  for (const Stencil& stencil : kit::law_stencils) {
    model::State state = kit::random_state(model, 3);
    dense.prepare(state, stencil);
    const auto taken = [&] {
      const model::StepWork work = batch->step_work(state, stencil);
      return work.damping + work.dissipation;
    };
    const double asked = taken();
    const double rounding = 1e-13 * batch->stored_energy(state.next);
    dense.residual(state, stencil, {batch});
    EXPECT_NEAR(taken(), asked, rounding);
    const model::Coordinates other = kit::random_state(model, 4).next;
    state.next = other;
    dense.tangent(state, stencil, {batch});
    const double asked_again = taken();
    EXPECT_EQ(std::abs(asked_again - asked) > 1e-3 * asked, asked != 0.0);
    dense.residual(state, stencil, {batch});
    EXPECT_NEAR(taken(), asked_again, rounding);
    batch->accept(state);
    EXPECT_EQ(taken(), asked_again);
    dense.prepare(state, stencil);
    EXPECT_EQ(taken(), asked_again);
  }
}

TYPED_TEST(ProjectedElement, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace([&](model::Model& model) { fill<TypeParam>(model, true); },
                                      effect);
}

TYPED_TEST(ProjectedElement, AssembleAllocatesNothing) {
  kit::expect_no_allocation([&](model::Model& model) { fill<TypeParam>(model, true); }, effect);
}

}  // namespace
}  // namespace culm::beam
