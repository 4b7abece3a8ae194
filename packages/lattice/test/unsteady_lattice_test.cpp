#include "lattice_kit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace culm::lattice {
namespace {

using kit::Wing;

// Steps of one panel with heave z(t), speed 1; returns the force in each step.
std::vector<Vec3> march(const Wing& wing, Panels panels, double alpha, LatticeSetting setting,
                        int steps, const std::function<double(double)>& heave = {}) {
  const Lattice lattice = kit::make(wing, panels, alpha, setting);
  const double h = wing.chord / panels.chord;
  const auto grid_at = [&](double time) {
    Points points = kit::grid(wing, panels);
    if (heave) {
      for (double& z : points.z) z += heave(time);
    }
    return points;
  };
  FluidState state = lattice.initial_state();
  Points velocity(lattice.bound().num_points());
  std::vector<Vec3> forces;
  for (int k = 0; k < steps; ++k) {
    const double start = k * h, end = start + h;
    GridStep grid{grid_at(start), grid_at(end), {}, start, end};
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      velocity.set(i, 2.0 / h * (grid.end.at(i) - grid.start.at(i)) - velocity.at(i));
    }
    grid.end_velocity = velocity;
    const auto coming = lattice.begin_step(state, grid.start, grid.end, start, end);
    const FluidResult result = lattice.step(state, coming, grid);
    forces.push_back(kit::total(result.forces));
    state = Lattice::state_after(result, coming.wake);
  }
  return forces;
}

const Wing plate{.half_span = 1e4, .inset = false};

// Error of the lift at Ut/c = 1, the mean of the steps before and after it, against Wagner's
// function at s = 2.
double plate_error(int panels) {
  const double alpha = 1e-3, wagner = 0.669290;
  const std::vector<Vec3> f =
      march(plate, {panels, 1}, alpha, {.rows = 4 * panels, .core = {.width = 0.0}}, panels + 1);
  const double at_one =
      0.5 * (f[static_cast<std::size_t>(panels - 1)].z() + f[static_cast<std::size_t>(panels)].z());
  return at_one / (0.5 * plate.half_span * 2.0 * std::numbers::pi * alpha) / wagner - 1.0;
}

TEST(UnsteadyLattice, SuddenStartConvergesToWagnerAtFirstOrder) {
  const double coarse = plate_error(8), middle = plate_error(16), fine = plate_error(32);
  EXPECT_NEAR(coarse, 0.0, 0.012);
  EXPECT_NEAR(fine, 0.0, 0.003);
  EXPECT_NEAR(coarse / middle, 2.0, 0.3);
  EXPECT_NEAR(middle / fine, 2.0, 0.3);
}

// Lift of heave z = a sin(w t) by Theodorsen, k = w c / 2 U:
//   L = rho U pi c C(k) (-z') - rho pi c^2 / 4 z''
double heave_error(int panels, double k, std::complex<double> C) {
  const double omega = 2.0 * k, a = 1e-3, h = 1.0 / panels;
  const double period = 2.0 * std::numbers::pi / omega;
  const int per_period = static_cast<int>(std::round(period / h));
  const int steps = 5 * per_period;
  // U h / panel must stay one, so the last period is not closed exactly: fit both harmonics
  const auto f = march(plate, {panels, 1}, 0.0, {.rows = 10 * panels * 40, .core = {.width = 0.0}},
                       steps, [&](double t) { return a * std::sin(omega * t); });
  Eigen::MatrixXd base(per_period, 2);
  Eigen::VectorXd lift(per_period);
  for (int i = 0; i < per_period; ++i) {
    const int step = steps - per_period + i;
    const double t = (step + 0.5) * h;
    base.row(i) << std::cos(omega * t), std::sin(omega * t);
    lift[i] = f[static_cast<std::size_t>(step)].z() / plate.half_span;
  }
  const Eigen::Vector2d fitted = (base.transpose() * base).inverse() * base.transpose() * lift;
  const std::complex<double> computed(fitted[0], -fitted[1]);  // of exp(i w t)
  // z = a sin: z' = a w cos, z'' = -a w^2 sin
  const std::complex<double> i(0.0, 1.0);
  const std::complex<double> exact =
      -std::numbers::pi * C * a * omega - i * std::numbers::pi / 4.0 * a * omega * omega;
  return std::abs(computed - exact) / std::abs(exact);
}

TEST(UnsteadyLattice, HeavingPlateConvergesToTheodorsen) {
  const std::complex<double> C(0.66497, -0.17932);  // C(0.3)
  const double coarse = heave_error(8, 0.3, C), fine = heave_error(16, 0.3, C);
  EXPECT_LT(coarse, 0.037);
  EXPECT_LT(fine, 0.019);
}

// Katz and Plotkin, figure 13.34; the same lattice computed by an independent program, which took
// pressures at the end of each step.
TEST(UnsteadyLattice, SuddenAccelerationOfWings) {
  const double alpha = 5.0 * std::numbers::pi / 180.0;
  const std::array<double, 7> times = {0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 9.0};
  const std::pair<double, std::array<double, 7>> tables[] = {
      {4.0, {.2735, .2840, .3004, .3088, .3159, .3184, .3195}},
      {8.0, {.3101, .3287, .3572, .3738, .3902, .3972, .4006}}};
  for (const auto& [ratio, table] : tables) {
    const Wing wing{.half_span = 0.5 * ratio, .inset = false};
    const auto f = march(wing, {8, 13}, alpha, {.rows = 80, .core = {.width = 0.0}}, 73);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto k = static_cast<std::size_t>(std::lround(8.0 * times[i]));
      const Vec3 mean = 0.5 * (f[k - 1] + f[k]);
      const double lift =
          (mean.z() * std::cos(alpha) - mean.x() * std::sin(alpha)) / wing.half_span * 2.0;
      const double allowed = times[i] < 1.0 ? 0.03 : 0.02;
      EXPECT_NEAR(lift, table[i], allowed * table[i]) << ratio << ' ' << times[i];
    }
  }
}

}  // namespace
}  // namespace culm::lattice
