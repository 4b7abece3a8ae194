#include "lattice_kit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace culm::lattice {
namespace {

using kit::Wing;

const Wing wing{.half_span = 2.0};
const Panels panels{2, 4};

// Steps of one panel of a wing that rests, from a state.
FluidState march(const Lattice& lattice, FluidState state, const Points& grid, int steps,
                 Vec3* force = nullptr) {
  const double h = wing.chord / panels.chord;
  const Points still(grid.size());
  for (int k = 0; k < steps; ++k) {
    const auto coming = lattice.begin_step(state, grid, grid, k * h, (k + 1) * h);
    const FluidResult result = lattice.step(state, coming, {grid, grid, still, k * h, (k + 1) * h});
    if (force != nullptr) *force = kit::total(result.forces);
    state = Lattice::state_after(result, coming.wake);
  }
  return state;
}

TEST(Wake, AStepFromTheSteadyStateChangesNothing) {
  const Lattice lattice = kit::make(wing, panels, 0.1);
  const Points grid = kit::grid(wing, panels);
  const FluidResult steady = lattice.steady(grid, 0.0);
  Vec3 force;
  march(lattice, lattice.steady_state(steady, grid, 0.0), grid, 5, &force);
  // the first rows have cores, which the straight wake has all along, so nothing differs but length
  EXPECT_NEAR((force - kit::total(steady.forces)).norm(), 0.0, 2e-3 * force.norm());
}

TEST(Wake, ALongMarchEndsInTheSteadyState) {
  const Lattice lattice = kit::make(wing, panels, 0.1, {.rows = 400});
  const Points grid = kit::grid(wing, panels);
  Vec3 force;
  march(lattice, lattice.initial_state(), grid, 300, &force);
  const Vec3 steady = kit::total(lattice.steady(grid, 0.0).forces);
  EXPECT_NEAR((force - steady).norm(), 0.0, 2e-3 * steady.norm());
}

TEST(Wake, NumbersOfAFixedSizeHoldAllOfIt) {
  const Lattice lattice = kit::make(wing, panels, 0.1, {.wake = WakeMotion::free, .rows = 7});
  const Points grid = kit::grid(wing, panels);
  for (const int steps : {0, 3, 7, 9}) {
    const FluidState state = march(lattice, lattice.initial_state(), grid, steps);
    EXPECT_EQ(state.wake.rows(), std::min(steps, 7));
    std::vector<double> memory(state.wake.memory_size());
    EXPECT_EQ(memory.size(), lattice.initial_state().wake.memory_size());
    state.wake.save(memory);
    Wake copy = lattice.initial_state().wake;
    copy.restore(memory);
    EXPECT_EQ(copy.lines().x, state.wake.lines().x);
    EXPECT_EQ(copy.lines().z, state.wake.lines().z);
    EXPECT_EQ(copy.circulation(), state.wake.circulation());
    EXPECT_EQ(copy.ages(), state.wake.ages());
  }
}

// The sheet behind a wing moves down in the middle, and its edge rolls up.
TEST(Wake, FreeWakesMoveWithWhatIsInduced) {
  const Points grid = kit::grid(wing, panels);
  const Lattice free = kit::make(wing, panels, 0.1, {.wake = WakeMotion::free, .rows = 40});
  const Lattice prescribed = kit::make(wing, panels, 0.1, {.rows = 40});
  const Wake moved = march(free, free.initial_state(), grid, 20).wake;
  const Wake straight = march(prescribed, prescribed.initial_state(), grid, 20).wake;
  const auto sinks = [&](int line, int j) {
    const auto at = static_cast<std::size_t>(line * (panels.span + 1) + j);
    return straight.lines().z[at] - moved.lines().z[at];
  };
  EXPECT_GT(sinks(12, 0), 0.05);
  EXPECT_LT(sinks(12, panels.span), 0.5 * sinks(12, 0));
  EXPECT_EQ(moved.rows(), straight.rows());
}

TEST(Wake, OneSurfaceActsOnTheOther) {
  Points both = kit::grid(wing, panels);
  const std::size_t one = both.size();
  for (std::size_t i = 0; i < one; ++i) both.push_back(both.at(i) + Vec3(3.0, 0.0, -0.3));
  const Lattice pair(BoundLattice({panels, panels}, both, Vec3(0.0, 1.0, 0.0)),
                     std::make_shared<kit::Wind>(Vec3(1.0, 0.0, 0.1)), {});
  const Points forces = pair.steady(both, 0.0).forces;
  double front = 0.0, rear = 0.0;
  for (std::size_t i = 0; i < one; ++i) {
    front += forces.z[i];
    rear += forces.z[one + i];
  }
  EXPECT_LT(rear, 0.7 * front);  // in the downwash
}

}  // namespace
}  // namespace culm::lattice
