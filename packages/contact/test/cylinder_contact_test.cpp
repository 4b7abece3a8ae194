#include <culm/contact/cylinder_contact.hpp>

#include "contact_laws.hpp"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace culm::contact {
namespace {

struct BarCase {
  int node;      ///< of the bar, or in space
  double reach;  ///< radius of the bar
  std::optional<double> length;
  Penalty penalty;
  Friction friction;
};

// Without ends, with a short axis whose ends are met, through the surface in the step, damped and
// rubbed, in space, rubbed along the axis.
const BarCase bar_cases[] = {
    {2, 9.0, {}, {3.0, 0.0, 0.0}, {}},         {2, 9.0, 0.4, {3.0, 0.0, 0.0}, {}},
    {2, 1.5, 0.4, {3.0, 4.0, 0.0}, {}},        {2, 9.0, 0.4, {3.0, 0.5, 0.05}, {0.4, 2.0}},
    {-1, 9.0, 0.4, {3.0, 0.5, 0.05}, {}},      {-1, 9.0, 0.4, {3.0, 0.5, 0.05}, {0.4, 2.0}},
    {2, 9.0, {}, {3.0, 0.0, 0.0}, {0.4, 50.0}}};

/// Points between two nodes, off their axis, against a bar on a third.
void fill_with_bar(model::Model& model, const BarCase& data, bool with_slave) {
  for (const int seed : {10, 11, 12}) model.nodes().add(kit::random_node(seed));
  const Cylinder bar{data.node, Vec3(0.3, -0.4, 0.2), Vec3(0.6, 0.0, 0.8), data.length, data.reach};
  auto load =
      std::make_unique<CylinderContact>(effect, model.nodes(), bar, data.penalty, data.friction);
  load->add({{{0, 1}, {0.3, 0.7}, Vec3(0.2, -0.1, 0.4)}, 0.5, 1.7});
  load->add({model::marker_at(1), 0.3, 0.6});
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(CylinderContact, ObeysTheLawsOfBatches) { expect_laws_of_batches(bar_cases, fill_with_bar); }

TEST(CylinderContact, WorkOfAStepIsAccountedForAndMomentaBalance) {
  expect_work_is_accounted_for(bar_cases, fill_with_bar,
                               [](const BarCase&, const Stencil& stencil, const ContactStep& step) {
                                 if (stencil.theta_strain == 0.5) {
                                   EXPECT_NEAR(step.work.dissipation, 0.0,
                                               1e-12 * (1.0 + std::abs(step.stored)));
                                 }
                                 expect_momenta_balance(step);
                               });
}

// A ball on either side of a bar at the ends of a step, beside its end, and in it from the start.
TEST(CylinderContact, NothingPassesThroughInOneStep) {
  model::Model model;
  const int node = model.nodes().add(kit::random_node(10));
  auto load = std::make_unique<CylinderContact>(effect, model.nodes(),
                                                Cylinder{-1, Vec3::Zero(), Vec3::UnitX(), 2.0, 1.0},
                                                Penalty{3.0, 0.0, 0.0}, Friction{});
  load->add({model::marker_at(node), 0.5, 1.0});
  model.add_load(std::move(load));
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  model::State state = kit::random_state(model, 3);
  const auto verdict = [&](const Vec3& from, const Vec3& to) {
    model::NodeTable::slots(state.prev, node).col(0) = from;
    model::NodeTable::slots(state.next, node).col(0) = to;
    const Stencil stencil = Stencil::midpoint(0.4);
    dense.prepare(state, stencil);
    return dense.assemble(state, stencil, Want::residual, {kit::find_batch(model, effect)});
  };
  EXPECT_EQ(verdict({1.0, 0.1, 5.0}, {1.1, 0.0, -5.0}), Verdict::law_out_of_range);
  EXPECT_EQ(verdict({-5.0, 0.1, 0.2}, {9.0, 0.1, 0.2}), Verdict::law_out_of_range);
  EXPECT_EQ(verdict({1.0, 0.0, 5.0}, {1.0, 0.0, 0.2}), Verdict::law_out_of_range);
  EXPECT_EQ(verdict({1.0, 0.0, 5.0}, {1.0, 0.0, 1.2}), Verdict::ok);
  EXPECT_EQ(verdict({3.0, 0.1, 5.0}, {3.0, 0.0, -5.0}), Verdict::ok);
  EXPECT_EQ(verdict({1.0, 0.9, 5.0}, {1.0, 0.9, -5.0}), Verdict::ok);
  EXPECT_EQ(verdict({1.0, 0.0, 0.3}, {1.0, 0.0, -5.0}), Verdict::ok);
}

// Beside the axis and beyond its end.
TEST(CylinderContact, SeesTheNearestPlaceOfTheBar) {
  model::Model model;
  const int node = model.nodes().add(kit::random_node(10));
  CylinderContact contact(effect, model.nodes(), {-1, Vec3::Zero(), Vec3::UnitX(), 2.0, 1.0},
                          {3.0, 0.0, 0.0}, {});
  contact.add({model::marker_at(node), 0.5, 1.0});
  model::Coordinates q = model.nodes().reference();
  model::NodeTable::slots(q, node).col(0) = Vec3(1.2, 0.0, 1.1);
  EXPECT_NEAR(contact.touch(q).depth, 0.4, 1e-14);
  model::NodeTable::slots(q, node).col(0) = Vec3(2.6, 0.8, 0.0);
  EXPECT_NEAR(contact.touch(q).depth, 0.5, 1e-14);
}

// Of points on both sides the bar is as deep as half of what is between them lets it; points along
// it see it, and spheres are no line.
TEST(CylinderContact, SaysWhatStandsBetweenItsPoints) {
  const auto overlooked = [](const Vec3& from, const Vec3& to, double length) {
    model::Model model;
    CylinderContact contact(effect, model.nodes(), {-1, Vec3::Zero(), Vec3::UnitX(), 2.0, 1.0},
                            {3.0, 0.0, 0.0}, {});
    std::vector<int> nodes;
    for (const int seed : {10, 11}) nodes.push_back(model.nodes().add(kit::random_node(seed)));
    for (const int node : nodes) contact.add({model::marker_at(node), 0.5, 1.0, length});
    model::Coordinates q = model.nodes().reference();
    model::NodeTable::slots(q, nodes[0]).col(0) = from;
    model::NodeTable::slots(q, nodes[1]).col(0) = to;
    return contact.overlooked(q);
  };
  EXPECT_THAT(overlooked({1.0, -2.0, 1.5}, {1.0, 2.0, 1.5 - 1e-9}, 4.0),
              testing::HasSubstr("points on its line 4 m apart, and the bar lies 1 m deeper"));
  EXPECT_EQ(overlooked({1.0, -2.0, 1.6}, {1.0, 2.0, 1.6}, 4.0), "");
  EXPECT_EQ(overlooked({1.0, -0.2, 1.4}, {1.0, 0.2, 1.4}, 0.4), "");
  EXPECT_EQ(overlooked({0.2, 0.0, 1.4}, {1.8, 0.0, 1.4}, 1.6), "");
  EXPECT_EQ(overlooked({1.0, -2.0, 1.4}, {1.0, 2.0, 1.4}, 1.0), "");
  EXPECT_EQ(overlooked({1.0, -2.0, 1.4}, {1.0, 2.0, 1.4}, 0.0), "");
}

}  // namespace
}  // namespace culm::contact
