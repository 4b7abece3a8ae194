// Derivatives of the forces by the motion of the grid.
#include "lattice_kit.hpp"

#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::lattice {
namespace {

const kit::Wing mirrored_wing{.half_span = 2.0, .inset = false};
constexpr Panels mirrored_panels{3, 4};

Points moved(const Points& grid, double way, const Points& change) {
  Points result = grid;
  for (std::size_t i = 0; i < grid.size(); ++i) result.add(i, way * change.at(i));
  return result;
}

// Leaves the edge at the mirror there.
Points some_motion(const Points& grid) {
  culm::kit::Random random(3);
  Points change;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    change.push_back(random.vector());
    if (grid.y[i] == 0.0) change.y[i] = 0.0;
  }
  return change;
}

double norm(const Points& a) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a.at(i).squaredNorm();
  return std::sqrt(sum);
}

double apart(const Points& a, const Points& b) { return norm(moved(a, -1.0, b)) / norm(b); }

// By central differences of what `forces` gives at a grid.
template <class Forces>
Points difference(const Points& grid, const Points& change, const Forces& forces) {
  constexpr double h = 1e-5;
  Points result = moved(forces(moved(grid, h, change)), -1.0, forces(moved(grid, -h, change)));
  for (std::size_t i = 0; i < result.size(); ++i) result.set(i, result.at(i) / (2.0 * h));
  return result;
}

double steady_error(double alpha) {
  const Lattice lattice = kit::make(mirrored_wing, mirrored_panels, alpha);
  const Points grid = kit::grid(mirrored_wing, mirrored_panels), change = some_motion(grid);
  const FluidResult result = lattice.steady(grid, 0.0);
  const GridStep step{grid, grid, {}, 0.0, 0.0};
  return apart(
      lattice.change_of_forces(result, result.circulation, step, change),
      difference(grid, change, [&](const Points& at) { return lattice.steady(at, 0.0).forces; }));
}

TEST(LatticeTangent, IsTheDerivativeOfASteadyFlow) {
  EXPECT_LT(steady_error(0.0), 1e-6);
  EXPECT_LT(steady_error(0.05), 0.1);
}

double step_error(double alpha, int before) {
  const Lattice lattice = kit::make(mirrored_wing, mirrored_panels, alpha);
  const Points grid = kit::grid(mirrored_wing, mirrored_panels), change = some_motion(grid);
  constexpr double h = 1.0 / 3.0;
  const auto result_at = [&](const FluidState& state, const Lattice::ComingWake& coming,
                             const Points& end, double time, GridStep& step) {
    step = {grid, end, Points(grid.size()), time, time + h};
    for (std::size_t i = 0; i < grid.size(); ++i) {
      step.end_velocity.set(i, 2.0 / h * (end.at(i) - grid.at(i)));
    }
    return lattice.step(state, coming, step);
  };
  FluidState state = lattice.initial_state();
  GridStep step;
  for (int k = 0; k < before; ++k) {
    const auto coming = lattice.begin_step(state, grid, grid, k * h, (k + 1) * h);
    state = Lattice::state_after(result_at(state, coming, grid, k * h, step), coming.wake);
  }
  const double time = before * h;
  const auto coming = lattice.begin_step(state, grid, grid, time, time + h);
  GridStep own;
  const FluidResult result = result_at(state, coming, grid, time, own);
  return apart(lattice.change_of_forces(result, state.circulation, own, change),
               difference(grid, change, [&](const Points& at) {
                 return result_at(state, coming, at, time, step).forces;
               }));
}

TEST(LatticeTangent, IsTheDerivativeOfAStep) {
  EXPECT_LT(step_error(0.0, 0), 1e-6);
  EXPECT_LT(step_error(0.05, 3), 0.1);
}

}  // namespace
}  // namespace culm::lattice
