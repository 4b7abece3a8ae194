// Air in small motions exp(s t).
#include <culm/lattice/harmonic_air.hpp>

#include "lattice_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace culm::lattice {
namespace {

using Complex = std::complex<double>;
using kit::Wing;

using std::numbers::pi;

// By column: up, and nose up about the middle of the chord.
Eigen::MatrixXd heave_and_pitch(const Wing& wing, const Points& grid) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(grid.size()), 2);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    motions.row(3 * static_cast<Eigen::Index>(i) + 2) << 1.0, 0.5 * wing.chord - grid.x[i];
  }
  return motions;
}

SmallMotions small_motions(const Wing& wing, Panels panels, double speed = 1.0) {
  const Points grid = kit::grid(wing, panels);
  const Lattice lattice(BoundLattice({panels}, grid, Vec3(0.0, 1.0, 0.0)),
                        std::make_shared<kit::Wind>(Vec3(speed, 0.0, 0.0)), {});
  return lattice.small_motions(lattice.steady(grid, 0.0), grid, 0.0, heave_and_pitch(wing, grid));
}

double largest_error(const Eigen::MatrixXcd& found, const Eigen::MatrixXcd& wanted) {
  return ((found - wanted).array() / wanted.array()).abs().maxCoeff();
}

// By Theodorsen for a plate of unit chord in a wind of 1 m/s, per span: heave up h and pitch nose
// up a about the middle; lift = pi / 4 (-h'' + a') + pi C (a - h' + a' / 4).
Eigen::MatrixXcd theodorsen(double k, Complex C) {
  const Complex s(0.0, 2.0 * k);
  const Eigen::RowVector2cd downwash(-s, 1.0 + 0.25 * s);
  const Eigen::RowVector2cd lift = 0.25 * pi * Eigen::RowVector2cd(-s * s, s) + pi * C * downwash;
  const Eigen::RowVector2cd moment =
      0.25 * pi * Eigen::RowVector2cd(0.0, -0.25 * s - s * s / 32.0) + 0.25 * pi * C * downwash;
  Eigen::Matrix2cd forces;
  forces << lift, moment;
  return -forces;
}

// The error falls like the panel, so two meshes give the limit.
TEST(HarmonicAir, OfAPlateTendsToTheodorsen) {
  const Wing plate{.half_span = 1e4, .inset = false};
  const std::pair<double, Complex> table[] = {{0.05, {0.90904, -0.13065}},
                                              {0.1, {0.83192, -0.17230}},
                                              {0.3, {0.66497, -0.17932}},
                                              {0.5, {0.59794, -0.15071}},
                                              {1.0, {0.53943, -0.10027}}};
  const auto air = [&](int panels, double k) {
    return Eigen::MatrixXcd(harmonic_air(small_motions(plate, {panels, 1}), Complex(0.0, 2.0 * k)) /
                            plate.half_span);
  };
  for (const auto& [k, C] : table) {
    const Eigen::MatrixXcd exact = theodorsen(k, C);
    const Eigen::MatrixXcd coarse = air(16, k), fine = air(32, k);
    EXPECT_LT(largest_error(fine, exact), 0.02) << k;
    EXPECT_NEAR(largest_error(coarse, exact) / largest_error(fine, exact), 2.0, 0.1) << k;
    EXPECT_LT(largest_error(2.0 * fine - coarse, exact), 2e-3) << k;
  }
}

// Of a motion that goes on for long, at a step of one panel: middles of steps leave a square of it.
TEST(HarmonicAir, IsThatOfAMotionInTime) {
  const Wing wing{.half_span = 2.0};
  constexpr Panels panels{8, 6};
  constexpr double h = 1.0 / 8.0;
  const double omega = 2.0 * pi / (80.0 * h);
  const Points still = kit::grid(wing, panels);
  const Eigen::MatrixXd motions = heave_and_pitch(wing, still);
  const Lattice lattice = kit::make(wing, panels, 0.0, {.rows = 400});
  const Eigen::MatrixXcd Q = harmonic_air(small_motions(wing, panels), Complex(0.0, omega));
  for (Eigen::Index motion = 0; motion < 2; ++motion) {
    const auto grid_at = [&](double time) {
      Points grid = still;
      for (std::size_t i = 0; i < grid.size(); ++i) {
        grid.z[i] +=
            1e-4 * std::sin(omega * time) * motions(3 * static_cast<Eigen::Index>(i) + 2, motion);
      }
      return grid;
    };
    FluidState state = lattice.initial_state();
    Points velocity(still.size());
    Eigen::Vector2cd sum = Eigen::Vector2cd::Zero();
    for (int k = 0; k < 400; ++k) {
      GridStep step{grid_at(k * h), grid_at((k + 1) * h), {}, k * h, (k + 1) * h};
      for (std::size_t i = 0; i < velocity.size(); ++i) {
        velocity.set(i, 2.0 / h * (step.end.at(i) - step.start.at(i)) - velocity.at(i));
      }
      step.end_velocity = velocity;
      const auto coming =
          lattice.begin_step(state, step.start, step.end, step.time_start, step.time_end);
      const FluidResult result = lattice.step(state, coming, step);
      state = Lattice::state_after(result, coming.wake);
      if (k < 320) continue;  // the last period
      for (std::size_t i = 0; i < still.size(); ++i) {
        const auto row = motions.row(3 * static_cast<Eigen::Index>(i) + 2).transpose();
        sum += result.forces.z[i] * row * std::polar(1.0, -omega * (k + 0.5) * h);
      }
    }
    const Eigen::Vector2cd found = Complex(0.0, 1.0) * sum / 40.0 / 1e-4;
    EXPECT_LT(largest_error(found, -Q.col(motion)), 1e-3) << motion;
  }
}

TEST(HarmonicAir, IsTheSteadyDerivativeWithoutFrequency) {
  const Wing wing{.half_span = 2.0};
  constexpr Panels panels{4, 5};
  for (const double alpha : {0.0, 0.05}) {
    const Lattice lattice = kit::make(wing, panels, alpha);
    const Points grid = kit::grid(wing, panels);
    const FluidResult steady = lattice.steady(grid, 0.0);
    const Eigen::MatrixXd motions = heave_and_pitch(wing, grid);
    const Eigen::MatrixXcd Q = harmonic_air(lattice.small_motions(steady, grid, 0.0, motions), 0.0);
    Points pitch(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      pitch.z[i] = motions(3 * static_cast<Eigen::Index>(i) + 2, 1);
    }
    const double lift = kit::total(lattice.change_of_forces(steady, steady.circulation,
                                                            {grid, grid, {}, 0.0, 0.0}, pitch))
                            .z();
    EXPECT_NEAR(Q(0, 1).real(), -lift, 1e-6 * lift) << alpha;
    EXPECT_EQ(Q(0, 1).imag(), 0.0);
  }
}

TEST(LaggedAir, IsThatOfHarmonicMotions) {
  for (const double half_span : {2.0, 10.0}) {
    for (const int chord : {4, 8, 16}) {
      const SmallMotions small = small_motions({.half_span = half_span}, {chord, 6}, 20.0);
      const LaggedAir lagged = fit_lags(small);
      const Eigen::MatrixXcd steady = harmonic_air(small, 0.0);
      const double end = std::min(2.0, 0.25 * chord);
      double worst = 0.0;
      for (double k = 0.01; k < end; k *= 1.3) {
        const Complex s(0.0, 2.0 * 20.0 * k);
        worst = std::max(worst, largest_error(steady + lagged.at(s), harmonic_air(small, s)));
      }
      EXPECT_LT(worst, 5e-4) << half_span << ' ' << chord;
    }
  }
}

TEST(LaggedAir, IsAMassAtRest) {
  const SmallMotions small = small_motions({.half_span = 2.0}, {8, 6}, 0.0);
  const LaggedAir lagged = fit_lags(small);
  EXPECT_TRUE(lagged.lags.empty());
  const Complex s(0.0, 3.0);
  EXPECT_LT((lagged.at(s) - harmonic_air(small, s)).norm(), 1e-12 * lagged.at(s).norm());
  EXPECT_LT(lagged.damping.norm(), 1e-12 * lagged.mass.norm());
  // pi rho c^2 / 4 per span without ends
  EXPECT_GT(lagged.mass(0, 0), 0.9 * 0.5 * pi);
  EXPECT_LT(lagged.mass(0, 0), 0.5 * pi);
}

}  // namespace
}  // namespace culm::lattice
