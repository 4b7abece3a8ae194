#include <culm/contact/cylinder_contact.hpp>

#include <Eigen/Geometry>
#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace culm::contact {
namespace {

constexpr const char* effect = "tested";

struct Case {
  int node;      ///< of the bar, or in space
  double reach;  ///< radius of the bar
  std::optional<double> length;
  Penalty penalty;
};

// Without ends, with a short axis whose ends are met, through the surface in the step, damped, in
// space.
const Case cases[] = {{2, 9.0, {}, {3.0, 0.0, 0.0}},
                      {2, 9.0, 0.4, {3.0, 0.0, 0.0}},
                      {2, 1.5, 0.4, {3.0, 4.0, 0.0}},
                      {2, 9.0, 0.4, {3.0, 0.5, 0.05}},
                      {-1, 9.0, 0.4, {3.0, 0.5, 0.05}}};

/// Points between two nodes, off their axis, against a bar on a third.
void fill(model::Model& model, const Case& data, bool with_slave) {
  for (const int seed : {10, 11, 12}) model.nodes().add(kit::random_node(seed));
  const Cylinder bar{data.node, Vec3(0.3, -0.4, 0.2), Vec3(0.6, 0.0, 0.8), data.length, data.reach};
  auto load = std::make_unique<CylinderContact>(effect, model.nodes(), bar, data.penalty);
  load->add({{{0, 1}, {0.3, 0.7}, Vec3(0.2, -0.1, 0.4)}, 0.5, 1.7});
  load->add({model::marker_at(1), 0.3, 0.6});
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(CylinderContact, TangentIsDerivativeOfResidual) {
  for (const Case& data : cases) {
    SCOPED_TRACE(testing::Message() << "case " << &data - cases);
    for (const bool slave : {false, true}) {
      kit::expect_tangent_is_derivative([&](model::Model& m) { fill(m, data, slave); }, effect,
                                        3e-4);
    }
  }
}

TEST(CylinderContact, NullSpaceResidualIsProjected) {
  kit::expect_residual_is_projected([](model::Model& m) { fill(m, cases[1], true); }, effect);
}

TEST(CylinderContact, AllocatesNothingAndLeavesNoTrace) {
  const auto make = [](model::Model& m) { fill(m, cases[3], true); };
  kit::expect_no_allocation(make, effect);
  kit::expect_attempts_leave_no_trace(make, effect);
}

TEST(CylinderContact, WorkOfAStepIsAccountedForAndMomentaBalance) {
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
      EXPECT_GT(r.norm(), 1e-3);
      EXPECT_NEAR(r.dot(next - prev), stored + work.damping + work.dissipation,
                  1e-12 * (1.0 + std::abs(stored)));
      EXPECT_GE(work.damping, -1e-12);
      if (stencil.theta_strain == 0.5) {
        EXPECT_NEAR(work.dissipation, 0.0, 1e-12 * (1.0 + std::abs(stored)));
      }
      Vec3 force = work.force;
      Vec3 moment = work.moment;
      for (int s = 0; s < 12; ++s) {
        const Vec3 f = r.segment<3>(3 * s);
        const Vec3 q = 0.5 * (prev.segment<3>(3 * s) + next.segment<3>(3 * s));
        if (s % 4 == 0) force += f;
        moment += q.cross(f);
      }
      EXPECT_LT(force.norm(), 1e-12 * (1.0 + r.norm()));
      EXPECT_LT(moment.norm(), 1e-12 * (1.0 + r.norm()));
    }
  }
}

// Beside the axis and beyond its end.
TEST(CylinderContact, SeesTheNearestPlaceOfTheBar) {
  model::Model model;
  const int node = model.nodes().add(kit::random_node(10));
  CylinderContact contact(effect, model.nodes(), {-1, Vec3::Zero(), Vec3::UnitX(), 2.0, 1.0},
                          {3.0, 0.0, 0.0});
  contact.add({model::marker_at(node), 0.5, 1.0});
  model::Coordinates q = model.nodes().reference();
  model::NodeTable::slots(q, node).col(0) = Vec3(1.2, 0.0, 1.1);
  EXPECT_NEAR(contact.touch(q).depth, 0.4, 1e-14);
  model::NodeTable::slots(q, node).col(0) = Vec3(2.6, 0.8, 0.0);
  EXPECT_NEAR(contact.touch(q).depth, 0.5, 1e-14);
}

}  // namespace
}  // namespace culm::contact
