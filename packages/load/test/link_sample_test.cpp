#include <culm/load/link_load.hpp>

#include <culm_kit/dense_assembly.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace culm::load {
namespace {

using model::NodeTable;

// A spring or damper of 30 N/m or 30 N s/m between the origins of two nodes that are 2 m apart.
class LinkSample : public testing::Test {
 protected:
  model::Model model;
  LinkLoad* link = nullptr;

  void fill(std::unique_ptr<LinkLaw> law, double free_length) {
    for (int i = 0; i < 2; ++i) {
      model::NodeSlots slots;
      slots << Vec3(0.0, 2.0 * i, 0.0), Mat3::Identity();
      model.nodes().add(slots);
    }
    auto load = std::make_unique<LinkLoad>("link", model.nodes(), std::move(law));
    Link between = distance_link(model.nodes(), {0, Vec3::Zero()}, {1, Vec3::Zero()});
    between.rest = free_length;
    load->add(std::move(between));
    link = load.get();
    model.add_load(std::move(load));
    model.freeze(model::Form::null_space);
  }
  static model::State stretched(model::State state, double by) {
    NodeTable::slots(state.next, 1)(1, 0) += by;
    state.time_prev = 0.0;
    state.time = 0.5;
    return state;
  }
};

TEST_F(LinkSample, ASpringHasItsForceBeforeTheFirstStep) {
  fill(std::make_unique<SpringLaw>(PiecewiseLinear::proportional(30.0)), 1.5);
  const kit::DenseAssembly dense(model);
  const LinkLoad::Sample sample = link->sample(0, model.initial_state());
  EXPECT_NEAR(sample.coordinate, 0.5, 1e-15);
  EXPECT_NEAR(sample.force, 15.0, 1e-13);
}

TEST_F(LinkSample, ForcesAreThoseOfTheStep) {
  fill(std::make_unique<SpringLaw>(PiecewiseLinear::proportional(30.0)), 1.5);
  kit::DenseAssembly dense(model);
  const model::State state = stretched(model.initial_state(), 0.2);
  dense.prepare(state, Stencil::midpoint(0.5));
  dense.residual(state, Stencil::midpoint(0.5));
  const LinkLoad::Sample sample = link->sample(0, state);
  EXPECT_NEAR(sample.coordinate, 0.7, 1e-14);
  EXPECT_NEAR(sample.force, 30.0 * 0.6, 1e-12);  // of the middle of the step
}

TEST_F(LinkSample, ADamperResistsItsRate) {
  fill(std::make_unique<DamperLaw>(PiecewiseLinear::proportional(30.0)), 2.0);
  kit::DenseAssembly dense(model);
  const model::State state = stretched(model.initial_state(), 0.2);
  dense.prepare(state, Stencil::midpoint(0.5));
  dense.residual(state, Stencil::midpoint(0.5));
  EXPECT_NEAR(link->sample(0, state).force, 30.0 * 0.2 / 0.5, 1e-12);
}

}  // namespace
}  // namespace culm::load
