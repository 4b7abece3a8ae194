#include <culm/shell/element_batches.hpp>
#include <culm/structure/plastic_batch.hpp>

#include "../src/yielding_layers.hpp"

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace culm::shell {
namespace {

constexpr const char* plastic_part = "Plasticity, wall";
constexpr double young_modulus = 200.0, poisson_ratio = 0.3, wall_thickness = 0.1;

material::PlaneStressPlasticity law(double yield_stress) {
  return {young_modulus, poisson_ratio, {yield_stress, 10.0, 5.0}};
}

std::shared_ptr<const material::Layup> wall(double yield_stress) {
  const double mu = young_modulus / (2.0 * (1.0 + poisson_ratio));
  const double lambda = 2.0 * mu * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
  material::StVenantKirchhoff elastic;
  elastic.C.setZero();
  elastic.C.topLeftCorner<3, 3>().setConstant(lambda);
  elastic.C.diagonal() += (Vec6() << 2.0 * mu, 2.0 * mu, 2.0 * mu, mu, mu, mu).finished();
  material::Material metal;
  metal.law = elastic;
  metal.density = 1.0;
  metal.plasticity = {law(yield_stress), 2};
  return std::make_shared<const material::Layup>(
      material::Layup{{material::Layer{metal, 0.4 * wall_thickness, 0.3},
                       material::Layer{metal, 0.6 * wall_thickness, -0.7}}});
}

// One distorted element, warped by the height of a corner.
void fill(model::Model& model, double yield_stress, double height) {
  const std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(1.1, 0.1, 0), Vec3(1.2, 0.9, height),
                                    Vec3(-0.1, 1.0, 0)};
  ShellForms::Nodes reference;
  std::array<int, 4> nodes{};
  for (std::size_t a = 0; a < 4; ++a) {
    model::NodeSlots slots = model::NodeSlots::Zero();
    slots.col(0) = corners[a];
    slots.col(1) = Vec3::UnitZ();
    nodes[a] = model.nodes().add(slots, NodeKind::node6);
    reference.middleCols<2>(2 * static_cast<int>(a)) = slots.leftCols<2>();
  }
  auto& batch = model::elements<ElasticShell>(model, "Shell");
  const int item = batch.add(ElasticShell(reference, wall(yield_stress)), nodes);
  add_yielding_layers(batch, {item}, "wall", model);
}

void fill_yielding(model::Model& model) { fill(model, 1.0, 0.1); }

model::State moved(const model::Model& model, int seed) {
  kit::Random random(seed);
  model::State state = model.initial_state();
  state.time_prev = 0.0;
  state.time = 0.4;
  for (double& value : state.next) value += 0.02 * random.number();
  for (int node = 0; node < model.nodes().size(); ++node) {  // empty slots stay empty
    model::NodeTable::slots(state.next, node).rightCols<2>().setZero();
  }
  return state;
}

TEST(YieldingShell, AssemblesWithoutHeap) {
  kit::expect_no_allocation(fill_yielding, plastic_part);
}
TEST(YieldingShell, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace(fill_yielding, plastic_part);
}

TEST(YieldingShell, TangentIsDerivativeOfResidual) {
  for (const Stencil& stencil : kit::law_stencils) {
    model::Model model;
    fill_yielding(model);
    model.freeze(model::Form::null_space);
    const kit::DenseAssembly::Batches tested = {kit::find_batch(model, plastic_part)};
    kit::DenseAssembly dense(model);
    model::State state = moved(model, 3);
    dense.prepare(state, Stencil::statics());
    dense.accept(state);
    state.prev = state.next;
    state.next = moved(model, 5).next;
    dense.prepare(state, stencil);
    const Eigen::MatrixXd K = dense.tangent(state, stencil, tested);
    const Eigen::MatrixXd expected = dense.difference_tangent(state, stencil, tested, 1e-6);
    EXPECT_GT(kit::largest(expected), 1e-2);
    EXPECT_LT(kit::largest(K - expected), 1e-5 * kit::largest(expected));
  }
}

TEST(YieldingShell, EnergyBalanceIsExact) {
  model::Model model;
  fill_yielding(model);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  const std::vector<model::Batch*> batches{kit::find_batch(model, "Shell"),
                                           kit::find_batch(model, plastic_part)};
  const auto stored = [&](const model::Coordinates& q) {
    return batches[0]->stored_energy(q) + batches[1]->stored_energy(q);
  };
  model::State state = model.initial_state();
  for (const int seed : {3, 4, 5}) {
    state.next = moved(model, seed).next;
    state.time = state.time_prev + 0.4;
    const Stencil stencil{0.4, 0.5, 0.5, 0.0};  // without inertia
    const double before = stored(state.prev);
    dense.prepare(state, stencil);
    const Eigen::VectorXd residual = dense.residual(state, stencil, batches);
    double work = 0.0;
    for (int node = 0; node < model.nodes().size(); ++node) {
      const auto& block = model.unknowns().block(model.unknowns().node_block(node));
      const model::NodeSlots way =
          model::NodeTable::slots(state.next, node) - model::NodeTable::slots(state.prev, node);
      work += residual.segment<3>(block.first).dot(way.col(0)) +
              residual.segment<3>(block.first + 3).dot(way.col(1));
    }
    const double heat = batches[1]->step_work(state, stencil).damping;
    dense.accept(state);
    const double after = stored(state.next);
    EXPECT_GT(heat, 1e-5);
    EXPECT_NEAR(work, after - before + heat, 1e-13 * (before + after + heat));
    state.prev = state.next;
    state.time_prev = state.time;
  }
}

// Stretched alike in both directions of its plane, free across: whatever the shape of the element,
// forces and stresses are those of the law, the same in all directions.
TEST(YieldingShell, MeetsEvenStates) {
  model::Model model;
  fill(model, 1.0, 0.0);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  constexpr double e = 0.02;
  model::State state = model.initial_state();
  for (int node = 0; node < model.nodes().size(); ++node) {
    auto slots = model::NodeTable::slots(state.next, node);
    slots.col(0) *= std::sqrt(1.0 + 2.0 * e);
    slots.col(1) *= std::sqrt(1.0 - 4.0 * e * poisson_ratio / (1.0 - poisson_ratio));
  }
  dense.prepare(state, Stencil::statics());
  dense.accept(state);
  const auto step = law(1.0).step(Vec3::Zero(), Vec3(e, e, 0.0), {}, 1.0);
  const double stress = (law(1.0).elastic(Vec3(e, e, 0.0)) - step.relief)[0];
  EXPECT_LT(stress, 0.5 * law(1.0).elastic(Vec3(e, e, 0.0))[0]);

  const auto& shells =
      dynamic_cast<const model::ElementBatch<ElasticShell>&>(*kit::find_batch(model, "Shell"));
  std::vector<double> found;
  shells.resultants(0, state.next, found);
  const ShellResultants expected =
      wall_thickness * stress * (ShellResultants() << 1, 1, 0, 0, 0, 0, 0, 0).finished();
  EXPECT_LT((Eigen::Map<const ShellResultants>(found.data()) - expected).norm(), 1e-13);

  ShellForms::Nodes slots;
  for (int a = 0; a < 4; ++a) {
    slots.middleCols<2>(2 * a) = model::NodeTable::slots(state.next, a).leftCols<2>();
  }
  ShellForms::Strain y;
  shells.element(0).strain(0, slots, y);
  std::vector<LayerState> states;
  for (const int layer : {0, 1}) {
    for (const double height : {-1.0, 0.0, 1.0}) {
      states.push_back(shells.element(0).layer_state(layer, height, y));
    }
  }
  shells.added_stresses().front()->add_layer_states(0, states);
  for (const LayerState& layer : states) {
    EXPECT_LT((layer.stress - stress * Vec6(Vec6::Unit(0) + Vec6::Unit(1))).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace culm::shell
