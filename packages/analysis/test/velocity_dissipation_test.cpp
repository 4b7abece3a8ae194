#include <culm/analysis/books.hpp>
#include <culm/model/velocity_dissipation.hpp>

#include "motion.hpp"

#include <gtest/gtest.h>

namespace culm::analysis {
namespace {

using model::NodeTable;
using model::VelocityDissipation;

// A thin body: no mass belongs to its d3.
void add_body(model::Model& model, const Vec3& place, const Vec3& omega) {
  model::NodeSlots slots;
  slots << place, Mat3::Identity();
  const int node = model.nodes().add(slots);
  model.add_structure("body").nodes = {node};
  SlotMatrix<4> mass = SlotMatrix<4>::Zero();
  mass.diagonal() << 2.0, 0.3, 0.4, 0.0;
  model.masses("Bodies").add(node, mass);
  model.add_initial_velocity({node, Vec3(0.1, 0.2, 0.0), omega, place});
}

// A chain, and a body that spins beside it.
void build_chain_and_body(model::Model& model) {
  build_free_chain(model);
  add_body(model, Vec3(0.0, 5.0, 0.0), Vec3(0.3, 1.0, 2.0));
}

void build_damped_chain_and_body(model::Model& model) {
  build_chain_and_body(model);
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
    if (!attempt(h).accepted) throw std::runtime_error("a step did not converge");
    const double taken = Books(*system, true).add(state, Stencil::midpoint(h)).dissipation;
    stepper->accept();
    return taken;
  }
  model::Momentum momentum() const { return system->momentum(state.next, state.velocity); }
  double energy() const { return system->energies(state.next, momentum().kinetic_energy).total(); }
};

TEST(VelocityDissipation, TakesTheEnergyItBooksAndKeepsMomenta) {
  Damped chains(build_damped_chain_and_body);
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
  Damped both(build_damped_chain_and_body);
  Motion free(build_chain_and_body);
  for (int i = 0; i < 10; ++i) both.step(0.05);
  free.advance(0.05, 10);
  both.system->synchronise(both.state);
  free.system->synchronise(free.state);
  EXPECT_LT((NodeTable::slots(both.state.next, 7) - NodeTable::slots(free.state.next, 7)).norm(),
            1e-11);
  EXPECT_GT((NodeTable::slots(both.state.next, 3) - NodeTable::slots(free.state.next, 3)).norm(),
            1e-6);
}

TEST(VelocityDissipation, SlotsWithoutMassKeepTheMeanVelocity) {
  // two plates that are one body to the dissipation but move differently
  Damped plates([](model::Model& model) {
    add_body(model, Vec3(0.0, 0.0, 0.0), Vec3(0.5, 1.0, 2.0));
    add_body(model, Vec3(2.0, 0.0, 0.0), Vec3(-1.0, 0.2, 0.3));
    VelocityDissipation::of(model).add_body({0, 1}, 0.3);
  });
  const double h = 0.1;
  plates.step(h);
  const model::State before = plates.state;
  plates.step(h);
  plates.system->synchronise(plates.state);
  for (int node = 0; node < 2; ++node) {
    for (int s = 0; s < 4; ++s) {
      const Vec3 plain = 2.0 / h *
                             (NodeTable::slots(plates.state.next, node).col(s) -
                              NodeTable::slots(before.next, node).col(s)) -
                         NodeTable::slots(before.velocity, node).col(s);
      const double change = (NodeTable::slots(plates.state.velocity, node).col(s) - plain).norm();
      if (s == 3) {
        EXPECT_LT(change, 1e-14);
      } else if (s > 0) {
        EXPECT_GT(change, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace culm::analysis
