#include "one_beam.hpp"

namespace culm::beam {
namespace {

using kit::effect;

model::StrainDamping relaxing() {
  model::StrainDamping damping;
  damping.branches = {{0.3, {0.5, 0.2, 0.1, 0.0, 1.0, 0.7}}, {2.0, std::vector<double>(6, 0.4)}};
  return damping;
}

const kit::FillModel fill_relaxing = one_beam(relaxing());

TEST(Relaxation, TangentIsDerivativeOfResidual) {
  kit::expect_tangent_is_derivative(fill_relaxing, effect);
}
TEST(Relaxation, AssemblesWithoutHeap) { kit::expect_no_allocation(fill_relaxing, effect); }
TEST(Relaxation, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace(fill_relaxing, effect);
}

// Work of the stress = change of the stored energy + what branches take, which is never negative,
// in steps of all lengths.
TEST(Relaxation, EnergyBalanceIsExact) {
  model::Model model;
  fill_relaxing(model);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  model::Batch* batch = kit::find_batch(model, effect);
  model::State state = kit::random_state(model, 3);
  state.next = state.prev;
  double stored = 0.0;
  int seed = 10;
  for (const double h : {1e-3, 0.4, 0.05, 30.0, 2.0}) {
    const Stencil stencil{h, 0.5, 0.5, 0.0};  // of a step without inertia
    state.prev = state.next;
    state.next = kit::random_state(model, ++seed).next;
    dense.prepare(state, stencil);
    const Eigen::VectorXd force = dense.residual(state, stencil, {batch});
    double work = 0.0;
    for (int node = 0; node < 3; ++node) {
      const model::NodeSlots moved =
          model::NodeTable::slots(state.next, node) - model::NodeTable::slots(state.prev, node);
      work += force.segment<12>(12 * node).dot(moved.reshaped());
    }
    const double before = batch->stored_energy(state.prev);
    const double taken = batch->step_work(state, stencil).damping;
    dense.accept(state);
    stored = batch->stored_energy(state.next);
    EXPECT_GT(taken, 0.0);
    EXPECT_NEAR(work, stored - before + taken, 1e-12 * (stored + taken)) << h;
  }
  // what a checkpoint keeps
  std::vector<double> memory(batch->memory_size());
  EXPECT_EQ(memory.size(), 2U * 6U * DirectorBeam<2>::num_points);
  batch->save(model::Items::owned, memory);
  batch->restore(std::vector<double>(memory.size(), 0.0));
  EXPECT_LT(batch->stored_energy(state.next), stored);
  batch->restore(memory);
  EXPECT_EQ(batch->stored_energy(state.next), stored);
}

TEST(Relaxation, ActsInStepsOfTimeOnly) {
  model::Model model;
  fill_relaxing(model);
  model::Model elastic;
  one_beam({})(elastic);
  for (model::Model* one : {&model, &elastic}) one->freeze(model::Form::null_space);
  kit::DenseAssembly relaxing_system(model), elastic_system(elastic);
  const model::State state = kit::random_state(model, 3);
  const auto force = [&](kit::DenseAssembly& dense, const Stencil& stencil) {
    dense.prepare(state, stencil);
    return dense.residual(state, stencil);
  };
  const Stencil statics = Stencil::statics();
  EXPECT_EQ(force(relaxing_system, statics), force(elastic_system, statics));
  const Stencil step{0.1, 0.5, 0.5, 0.0};
  EXPECT_GT((force(relaxing_system, step) - force(elastic_system, step)).norm(), 1e-3);
}

}  // namespace
}  // namespace culm::beam
