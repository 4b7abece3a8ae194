#include <culm/contact/plane_contact.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace culm::contact {
namespace {

constexpr const char* effect = "tested";

struct Case {
  double height;  ///< of the plane
  Penalty penalty;
  Friction friction;
};

// Pressed all the time, through the plane within the step, damped, sliding, sticking.
const Case cases[] = {{9.0, {3.0, 0.0, 0.0}, {}},
                      {0.3, {3.0, 4.0, 0.0}, {}},
                      {9.0, {3.0, 0.5, 0.1}, {}},
                      {9.0, {3.0, 0.5, 0.1}, {0.4, 2.0}},
                      {9.0, {3.0, 0.5, 0.0}, {0.4, 50.0}}};

/// A point between two nodes, off their axis, and a sphere about a third.
void fill(model::Model& model, const Case& data, bool with_slave) {
  for (const int seed : {10, 11, 12}) model.nodes().add(kit::random_node(seed));
  const Vec3 normal = Vec3(0.1, -0.3, 1.0).normalized();
  auto load = std::make_unique<PlaneContact>(
      effect, model.nodes(), Plane{data.height * normal, normal}, data.penalty, data.friction);
  load->add({{{0, 1}, {0.3, 0.7}, Vec3(0.2, -0.1, 0.4)}, 0.5, 1.7});
  load->add({model::marker_at(2), 0.3, 0.6});
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(PlaneContact, TangentIsDerivativeOfResidual) {
  for (const Case& data : cases) {
    SCOPED_TRACE(testing::Message() << "case " << &data - cases);
    for (const bool slave : {false, true}) {
      kit::expect_tangent_is_derivative([&](model::Model& m) { fill(m, data, slave); }, effect,
                                        3e-4);
    }
  }
}

TEST(PlaneContact, NullSpaceResidualIsProjected) {
  kit::expect_residual_is_projected([](model::Model& m) { fill(m, cases[3], true); }, effect);
}

TEST(PlaneContact, AllocatesNothingAndLeavesNoTrace) {
  const auto make = [](model::Model& m) { fill(m, cases[3], true); };
  kit::expect_no_allocation(make, effect);
  kit::expect_attempts_leave_no_trace(make, effect);
}

// The work of a step is what is stored and what damping and friction take, both >= 0.
TEST(PlaneContact, WorkOfAStepIsAccountedFor) {
  for (const Case& data : cases) {
    model::Model model;
    fill(model, data, false);
    model.freeze(model::Form::multipliers);
    const model::State state = kit::random_state(model, 3);
    kit::DenseAssembly dense(model);
    model::Batch* batch = kit::find_batch(model, effect);
    for (const Stencil& stencil : {Stencil::midpoint(0.4), Stencil{0.4, 0.5, 0.75}}) {
      const Eigen::VectorXd r = dense.residual(state, stencil, {batch}).head(36);
      const Eigen::Map<const Eigen::VectorXd> prev(state.prev.data(), 36),
          next(state.next.data(), 36);
      const double stored = batch->stored_energy(state.next) - batch->stored_energy(state.prev);
      const model::StepWork work = batch->step_work(state, stencil);
      EXPECT_NEAR(r.dot(next - prev), stored + work.damping + work.dissipation,
                  1e-12 * (1.0 + std::abs(stored)));
      EXPECT_GE(work.damping, 0.0);
      EXPECT_GE(work.dissipation, -1e-12);
      if (data.friction.coefficient > 0.0) {
        EXPECT_GT(work.damping, 1e-3);
      }
    }
  }
}

TEST(PlaneContact, TellsWhatTouches) {
  model::Model model;
  const int node = model.nodes().add(kit::random_node(10));
  PlaneContact contact(effect, model.nodes(), {Vec3::Zero(), Vec3::UnitZ()}, {3.0, 0.0, 0.0}, {});
  contact.add({model::marker_at(node), 0.5, 2.0});
  model::Coordinates q = model.nodes().reference();
  q[2] = 0.1;
  EXPECT_NEAR(contact.touch(q).depth, 0.4, 1e-15);
  EXPECT_NEAR(contact.touch(q).force, 2.4, 1e-15);
  EXPECT_EQ(contact.touch(q).area, 2.0);
  q[2] = 0.6;
  EXPECT_NEAR(contact.touch(q).depth, -0.1, 1e-15);
  EXPECT_EQ(contact.touch(q).force, 0.0);
}

}  // namespace
}  // namespace culm::contact
