#include "one_beam.hpp"

namespace culm::beam {
namespace {

using kit::effect;

const std::vector<double> six{0.3, 0.1, 0.0, 0.7, 0.2, 0.5};

TEST(StrainDamping, TangentIsDerivativeOfResidual) {
  kit::expect_tangent_is_derivative(one_beam({0.2, 0.1, six}), effect);
}

TEST(StrainDamping, AssemblesWithoutHeap) {
  kit::expect_no_allocation(one_beam({0.0, 0.0, six}), effect);
}

struct Step {
  explicit Step(const model::StrainDamping& damping) {
    one_beam(damping)(model);
    model.freeze(model::Form::multipliers);
    state = kit::random_state(model, 3);
    kit::DenseAssembly dense(model);
    dense.prepare(state, stencil);
    batch = kit::find_batch(model, effect);
    force = dense.residual(state, stencil, {batch}).head(36);
  }
  double work() const {
    double sum = 0.0;
    for (int node = 0; node < 3; ++node) {
      const model::NodeSlots moved =
          model::NodeTable::slots(state.next, node) - model::NodeTable::slots(state.prev, node);
      sum += force.segment<12>(12 * node).dot(moved.reshaped());
    }
    return sum;
  }

  model::Model model;
  model::State state;
  Stencil stencil{0.4, 0.5, 0.5, 0.0};  // of a step without inertia
  model::Batch* batch = nullptr;
  Eigen::VectorXd force;
};

TEST(StrainDamping, SixEqualFactorsAreOne) {
  const Step one({0.0, 0.3, {}});
  const Step each({0.0, 0.0, std::vector<double>(6, 0.3)});
  EXPECT_LT((each.force - one.force).norm(), 1e-13 * one.force.norm());
  EXPECT_NEAR(each.batch->step_work(each.state, each.stencil).damping,
              one.batch->step_work(one.state, one.stencil).damping, 1e-13);
}

// Work of the stress = change of the stored energy + what damping takes, which is never negative.
TEST(StrainDamping, EnergyBalanceIsExact) {
  for (const double dissipation : {0.0, 0.4}) {
    const Step step({dissipation, 0.05, six});
    const model::StepWork work = step.batch->step_work(step.state, step.stencil);
    const double stored =
        step.batch->stored_energy(step.state.next) - step.batch->stored_energy(step.state.prev);
    EXPECT_GT(work.damping, 0.0);
    EXPECT_EQ(work.dissipation > 0.0, dissipation > 0.0);
    EXPECT_NEAR(step.work(), stored + work.damping + work.dissipation,
                1e-13 * (std::abs(stored) + work.damping));
  }
}

}  // namespace
}  // namespace culm::beam
