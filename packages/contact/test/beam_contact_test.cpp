#include <culm/contact/beam_contact.hpp>

#include <Eigen/Geometry>
#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace culm::contact {
namespace {

constexpr const char* effect = "tested";
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

TEST(BeamContact, TangentIsDerivativeOfResidual) {
  for (const Case& data : cases) {
    SCOPED_TRACE(testing::Message() << "case " << &data - cases);
    for (const bool slave : {false, true}) {
      kit::expect_tangent_is_derivative([&](model::Model& m) { fill(m, data, slave); }, effect,
                                        3e-4);
    }
  }
}

TEST(BeamContact, NullSpaceResidualIsProjected) {
  kit::expect_residual_is_projected([](model::Model& m) { fill(m, cases[3], true); }, effect);
}

TEST(BeamContact, AllocatesNothingAndLeavesNoTrace) {
  const auto make = [](model::Model& m) { fill(m, cases[3], true); };
  kit::expect_no_allocation(make, effect);
  kit::expect_attempts_leave_no_trace(make, effect);
}

TEST(BeamContact, WorkOfAStepIsAccountedForAndMomentaBalance) {
  for (const Case& data : cases) {
    model::Model model;
    fill(model, data, false);
    model.freeze(model::Form::multipliers);
    const model::State state = kit::random_state(model, 3);
    kit::DenseAssembly dense(model);
    model::Batch* batch = kit::find_batch(model, effect);
    for (const Stencil& stencil : {Stencil::midpoint(0.4), Stencil{0.4, 0.5, 0.75}}) {
      const Eigen::VectorXd r = dense.residual(state, stencil, {batch}).head(60);
      const Eigen::Map<const Eigen::VectorXd> prev(state.prev.data(), 60),
          next(state.next.data(), 60);
      const double stored = batch->stored_energy(state.next) - batch->stored_energy(state.prev);
      const model::StepWork work = batch->step_work(state, stencil);
      EXPECT_GT(r.norm(), 1e-3);
      EXPECT_NEAR(r.dot(next - prev), stored + work.damping + work.dissipation,
                  1e-12 * (1.0 + std::abs(stored)));
      EXPECT_GE(work.damping, -1e-12);
      EXPECT_GE(work.dissipation, -1e-12);
      if (data.friction.coefficient > 0.0) {
        EXPECT_GT(work.damping, 1e-3);
      }
      Vec3 force = Vec3::Zero();
      Vec3 moment = Vec3::Zero();
      for (int s = 0; s < 20; ++s) {
        const Vec3 f = r.segment<3>(3 * s);
        if (s % 4 == 0) force += f;
        moment += (0.5 * (prev.segment<3>(3 * s) + next.segment<3>(3 * s))).cross(f);
      }
      EXPECT_LT(force.norm(), 1e-12 * (1.0 + r.norm()));
      EXPECT_LT(moment.norm(), 1e-11 * (1.0 + r.norm()));
    }
  }
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
