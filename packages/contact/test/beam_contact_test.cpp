#include <culm/contact/beam_contact.hpp>

#include "contact_laws.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace culm::contact {
namespace {

constexpr double reach = 9.0;

struct Case {
  double damping;
  Friction friction;
};

// Elastic, damped, sliding, sticking.
const Case cases[] = {{0.0, {}}, {0.1, {}}, {0.0, {0.4, 2.0}}, {0.1, {0.4, 50.0}}};

int add_node(model::Model& model, int seed, const Vec3& x) {
  model::NodeSlots slots = kit::random_node(seed);
  slots.col(0) = x;
  return model.nodes().add(slots);
}

LineElement element_of(const model::Model& model, std::vector<int> nodes, double length) {
  const std::size_t count = nodes.size();
  const std::vector<model::LinePoint> points = {
      {{std::move(nodes), std::vector<double>(count, 1.0 / static_cast<double>(count)),
        Vec3::Zero()},
       length}};
  return divide(points, model.nodes().reference(), 1.5).front();
}

/// An element of order 1 and one of order 2 that crosses it at a distance.
void fill(model::Model& model, const Case& data, bool with_slave) {
  add_node(model, 10, Vec3(-2.0, 0.0, 0.0));
  add_node(model, 11, Vec3(2.5, 0.5, 0.0));
  add_node(model, 12, Vec3(0.5, -3.0, 7.5));
  add_node(model, 13, Vec3(0.0, 0.0, 7.6));
  add_node(model, 14, Vec3(0.0, 3.0, 7.5));
  model.add_load(std::make_unique<BeamContact>(
      effect, model.nodes(), Repulsion::of_lines(reach, 3.0, 1.0, data.damping), data.friction, 7.0,
      std::vector{element_of(model, {0, 1}, 4.5)}, std::vector{element_of(model, {2, 3, 4}, 6.0)}));
  if (with_slave) {
    const int master = add_node(model, 20, Vec3(-2.5, 0.3, 0.2));
    model.add_rigid_link("link", master, 0);
  }
}

TEST(BeamContact, ObeysTheLawsOfBatches) { expect_laws_of_batches(cases, fill); }

TEST(BeamContact, WorkOfAStepIsAccountedForAndMomentaBalance) {
  expect_work_is_accounted_for(cases, fill,
                               [](const Case&, const Stencil&, const ContactStep& step) {
                                 EXPECT_EQ(step.work.force, Vec3::Zero());
                                 expect_momenta_balance(step);
                               });
}

/// Two straight lines of some length, the second turned about z and lifted.
struct Lines {
  model::Model model;
  std::unique_ptr<BeamContact> contact;

  Lines(const Repulsion& law, double length, double angle, double height, double spacing) {
    const Vec3 half(0.5 * length, 0.0, 0.0);
    const Vec3 other = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * half;
    const Vec3 up(0.0, 0.0, height);
    int node = 0;
    for (const Vec3& x : {Vec3(-half), half, Vec3(up - other), Vec3(up + other)}) {
      add_node(model, ++node, x);
    }
    const auto line = [&](int first, double apart) {
      return divide({{{{first, first + 1}, {0.5, 0.5}, Vec3::Zero()}, length}},
                    model.nodes().reference(), apart);
    };
    contact = std::make_unique<BeamContact>(effect, model.nodes(), law, Friction{}, 0.1,
                                            line(0, spacing), line(2, 0.8 * spacing));
  }
  Touch touch() const { return contact->touch(model.nodes().reference()); }
};

// Along each other the force per length is that of the deck; what the ends lack is left out by the
// difference of two lengths.
TEST(BeamContact, LinesAlongEachOtherPressWithTheForceOfTheDeck) {
  const Repulsion law = Repulsion::of_lines(0.1, 500.0, 2e-3, 0.0);
  const double longer = Lines(law, 2.0, 0.0, 0.098, 5e-3).touch().force;
  const double shorter = Lines(law, 1.0, 0.0, 0.098, 5e-3).touch().force;
  EXPECT_NEAR(longer - shorter, 500.0, 0.5);
  EXPECT_NEAR(Lines(law, 1.0, 0.0, 0.098, 5e-3).touch().depth, 2e-3, 6e-5);
  EXPECT_NEAR(Lines(law, 1.0, 0.0, 0.098, 5e-3).touch().area, 0.1, 1e-12);
}

// Across each other it is 2 pi K D (R^2 - D^2)^2 / sin(angle), wherever the points lie.
TEST(BeamContact, LinesThatCrossPressWithTheForceOfTheTheory) {
  const Repulsion law = Repulsion::of_lines(0.1, 500.0, 2e-3, 0.0);
  const double D = 0.098;
  const double inside = 0.1 * 0.1 - D * D;
  for (const double angle : {1.5708, 0.7, 0.3}) {
    for (const double length : {0.977, 1.0, 1.013}) {
      const double force =
          2.0 * std::numbers::pi * law.strength * D * inside * inside / std::sin(angle);
      EXPECT_NEAR(Lines(law, length, angle, D, 5e-3).touch().force, force, 1e-2 * force);
      EXPECT_NEAR(Lines(law, length, angle, D, 1e-3).touch().force, force, 1e-4 * force);
    }
  }
}

TEST(BeamContact, BeamsCannotPassThroughEachOther) {
  Lines lines(Repulsion::of_lines(0.1, 500.0, 2e-3, 0.0), 1.0, 1.0, 0.11, 5e-3);
  lines.model.add_load(std::move(lines.contact));
  lines.model.freeze(model::Form::null_space);
  model::State state = lines.model.initial_state();
  for (const int node : {2, 3}) model::NodeTable::slots(state.next, node)(2, 0) = -0.11;
  kit::DenseAssembly dense(lines.model);
  EXPECT_EQ(dense.assemble(state, Stencil::midpoint(0.1), Want::residual,
                           {kit::find_batch(lines.model, effect)}),
            Verdict::law_out_of_range);
}

}  // namespace
}  // namespace culm::contact
