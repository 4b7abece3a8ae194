#include "motion.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace culm::analysis {
namespace {

using model::NodeTable;
using model::VelocityDissipation;

// Two chains that touch nowhere; the first is damped.
void build_two_chains(model::Model& model) {
  build_free_chain(model);
  kit::add_chain(model, 4);
  VelocityDissipation::of(model).add_body({0, 1, 2, 3, 4, 5, 6}, 0.5);
}

// A chain in a row that spins about the axis through its middle, stretched as the spin demands.
void build_spinning_chain(model::Model& model) {
  kit::add_chain(model, 6, 1e6);
  for (int node = 0; node <= 6; ++node) {
    model.add_initial_velocity({node, Vec3(0.1, 0.0, 0.3), Vec3(0.0, 0.0, 2.0), Vec3(3.0, 0, 0)});
  }
  VelocityDissipation::of(model).add_body({0, 1, 2, 3, 4, 5, 6}, 0.5);
}

class Damped : public Motion {
 public:
  explicit Damped(const std::function<void(model::Model&)>& build) : Motion(build) {}
  // one step; returns what the dissipation took
  double step(double h) {
    if (!solve(h).converged()) throw std::runtime_error("a step did not converge");
    scheme->finish(state, h);
    system->velocity_dissipation()->correct(state, h);
    const double taken = system->step_work(state, stencil).dissipation;
    accept(state);
    return taken;
  }
  model::Momentum momentum() const { return system->momentum(state.next, state.velocity); }
  double energy() const { return system->energies(state.next, momentum()).total(); }
};

TEST(VelocityDissipation, TakesTheEnergyItBooksAndKeepsMomenta) {
  Damped chains(build_two_chains);
  const model::Momentum start = chains.momentum();
  double energy = chains.energy();
  const double first = energy;
  double taken = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double step = chains.step(0.05);
    EXPECT_GE(step, 0.0);
    EXPECT_NEAR(chains.energy(), energy - step, 1e-11 * first);
    energy = chains.energy();
    taken += step;
  }
  EXPECT_GT(taken, 1e-3 * first);
  EXPECT_LT((chains.momentum().linear - start.linear).norm(), 1e-11 * start.linear.norm());
  EXPECT_LT((chains.momentum().angular - start.angular).norm(), 1e-11 * start.angular.norm());
}

TEST(VelocityDissipation, DoesNotBrakeASteadySpin) {
  Damped chain(build_spinning_chain);
  const double first = chain.energy();
  for (int i = 0; i < 200; ++i) chain.step(0.02);
  // 2e-3 is lost by dissipation that is linear in Dv in a single step of this kind
  EXPECT_LT(1.0 - chain.energy() / first, 2e-3);
}

TEST(VelocityDissipation, LeavesOtherBodiesAlone) {
  Damped both(build_two_chains);
  for (int i = 0; i < 10; ++i) both.step(0.05);
  both.system->synchronise(both.state);
  // the second chain is at rest and stays there
  for (int node = 7; node < 12; ++node) {
    EXPECT_LT((NodeTable::slots(both.state.next, node) -
               NodeTable::slots(both.model.nodes().reference(), node))
                  .norm(),
              1e-12);
  }
}

TEST(VelocityDissipation, SlotsWithoutMassKeepTheMeanVelocity) {
  const auto build = [](model::Model& model) {
    build_top(model);
    SlotMatrix<4> mass = SlotMatrix<4>::Zero();
    mass.diagonal() << 2.0, 0.3, 0.4, 0.0;
    model::NodeSlots slots;
    slots << Vec3(5.0, 0, 0), Mat3::Identity();
    model.add_structure("plate").nodes = {model.nodes().add(slots)};
    model.masses("Point masses").add(1, mass);
    model.add_initial_velocity({1, Vec3(1, 0, 0), Vec3(0.5, 1.0, 2.0), Vec3::Zero()});
    VelocityDissipation::of(model).add_body({1}, 1.0);
  };
  Damped plate(build);
  const double h = 0.1;
  for (int i = 0; i < 3; ++i) {
    const model::State before = plate.state;
    plate.step(h);
    for (int s = 0; s < 4; ++s) {
      const Vec3 plain = 2.0 / h *
                             (NodeTable::slots(plate.state.next, 1).col(s) -
                              NodeTable::slots(before.next, 1).col(s)) -
                         NodeTable::slots(before.velocity, 1).col(s);
      const double change = (NodeTable::slots(plate.state.velocity, 1).col(s) - plain).norm();
      if (s == 3) {
        EXPECT_LT(change, 1e-14);
      } else if (i == 2 && s > 0) {
        EXPECT_GT(change, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace culm::analysis
