#include <culm/load/field_load.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace culm::load {
namespace {

using kit::effect;

// f = (sin y, x z, t x^2)
class Waves final : public model::VectorField {
 public:
  Vec3 value(const Vec3& x, double t) const override {
    return {std::sin(x[1]), x[0] * x[2], t * x[0] * x[0]};
  }
  Mat3 gradient(const Vec3& x, double t) const override {
    Mat3 gradient;
    gradient << 0.0, std::cos(x[1]), 0.0, x[2], 0.0, x[0], 2.0 * t * x[0], 0.0, 0.0;
    return gradient;
  }
};

model::Marker point() { return {{0, 1}, {0.3, 0.7}, Vec3(0.2, -0.1, 0.4)}; }

void fill_with_waves(model::Model& model, bool with_slave) {
  for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
  const auto amplitude = model::Amplitude::of_time([](double t) { return 1.0 + t; });
  auto load =
      std::make_unique<FieldLoad>(effect, model.nodes(), amplitude, std::make_shared<Waves>());
  load->add(point(), 1.7);
  load->add(model::marker_at(1), 0.6);
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(FieldLoad, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    kit::expect_tangent_is_derivative(
        [&](model::Model& model) { fill_with_waves(model, with_slave); }, effect);
  }
}

TEST(FieldLoad, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    kit::expect_residual_is_projected(
        [&](model::Model& model) { fill_with_waves(model, with_slave); }, effect);
  }
}

TEST(FieldLoad, AssembleAllocatesNothing) {
  kit::expect_no_allocation([](model::Model& model) { fill_with_waves(model, true); }, effect);
}

// Force at the place in the middle of the step, at its time, and the work of it.
TEST(FieldLoad, ActsInTheMiddleOfAStep) {
  model::Model model;
  fill_with_waves(model, false);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  const Stencil stencil = Stencil::midpoint(state.time - state.time_prev);
  model::Batch* batch = kit::find_batch(model, effect);
  const Vec<24> r = dense.residual(state, stencil, {batch}).head<24>();  // then come multipliers
  const Eigen::Map<const Vec<24>> prev(state.prev.data());
  const Eigen::Map<const Vec<24>> next(state.next.data());
  const model::StepWork work = batch->step_work(state, stencil);
  EXPECT_NEAR(work.external, -r.dot(next - prev), 1e-13);

  const double time = 0.5 * (state.time_prev + state.time);
  const auto at = [&](const model::Marker& marker) {
    Vec3 x = Vec3::Zero();
    for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
      const model::NodeSlots q = 0.5 * (model::NodeTable::slots(state.prev, marker.nodes[a]) +
                                        model::NodeTable::slots(state.next, marker.nodes[a]));
      x += marker.weights[a] * (q.col(0) + q.rightCols<3>() * marker.offset);
    }
    return x;
  };
  const Waves field;
  const Vec3 expected = (1.0 + time) * (1.7 * field.value(at(point()), time) +
                                        0.6 * field.value(at(model::marker_at(1)), time));
  EXPECT_LT((work.force - expected).norm(), 1e-13);
}

}  // namespace
}  // namespace culm::load
