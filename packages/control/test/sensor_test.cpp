#include <culm/control/sensor.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <tuple>

namespace culm::control {
namespace {

using kit::effect;
using kit::oblique;

void fill_with_sensors(model::Model& model, Measured measured, bool follows, bool with_slave) {
  for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
  auto batch = std::make_unique<SensorBatch>(effect, model);
  const joint::TurnAxis axis{oblique, follows};
  batch->add("one", measured, {{0, axis}}, 0.7);
  batch->add("relative", measured, {{1, axis}, {0, axis}}, 1.3);
  model.add_load(std::move(batch));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

class Sensors : public testing::TestWithParam<std::tuple<Measured, bool>> {};

TEST_P(Sensors, TangentIsDerivativeOfResidual) {
  const auto [measured, follows] = GetParam();
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    kit::expect_tangent_is_derivative(
        [&](model::Model& model) { fill_with_sensors(model, measured, follows, with_slave); },
        effect, 1e-3);
  }
}

TEST_P(Sensors, AssembleAllocatesNothing) {
  const auto [measured, follows] = GetParam();
  kit::expect_no_allocation(
      [&](model::Model& model) { fill_with_sensors(model, measured, follows, true); }, effect);
}

INSTANTIATE_TEST_SUITE_P(All, Sensors,
                         testing::Values(std::tuple{Measured::angular_velocity, false},
                                         std::tuple{Measured::angular_velocity, true},
                                         std::tuple{Measured::velocity, false},
                                         std::tuple{Measured::displacement, false}));

// A steady turn of both nodes about the axis is read exactly at any step, and cancels between them.
TEST(Sensors, ReadsASteadyTurn) {
  model::Model model;
  fill_with_sensors(model, Measured::angular_velocity, false, false);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  model::State state = model.initial_state();
  const Stencil stencil = Stencil::midpoint(0.4);
  for (int node = 0; node < 2; ++node) {
    auto slots = model::NodeTable::slots(state.next, node);
    slots = exp_rotation(0.4 * 2.5 * oblique) * slots.eval();
  }
  state.own = {2.5, 0.0};
  EXPECT_LT(kit::largest(dense.residual(state, stencil).tail<2>()), 1e-14);
}

}  // namespace
}  // namespace culm::control
