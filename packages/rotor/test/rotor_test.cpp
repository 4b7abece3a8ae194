// Functions of a rotor, against closed forms.
#include <culm/rotor/dynamic_inflow.hpp>
#include <culm/rotor/induction.hpp>
#include <culm/rotor/skewed_wake.hpp>

#include "rotor_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::rotor {
namespace {

using std::numbers::pi;
using test::element;

// Half of the last digit that the references have.
constexpr double last_of_six = 0.5e-6;

TEST(Losses, FollowPrandtl) {
  const AnnulusPlace place{3, 50.0, 1.5, 63.0};
  const double sine = std::sin(0.1);
  const double tip = 2.0 / pi * std::acos(std::exp(-1.5 * 13.0 / 50.0 / sine));
  const double hub = 2.0 / pi * std::acos(std::exp(-1.5 * 48.5 / 1.5 / sine));
  EXPECT_NEAR(loss_factor({true, false}, place, 0.1), tip, 1e-15);
  EXPECT_NEAR(loss_factor({true, true}, place, -0.1), tip * hub, 1e-15);
  EXPECT_EQ(loss_factor({false, false}, place, 0.1), 1.0);
}

TEST(Losses, AreCompleteAtTheEndsAndBeyond) {
  EXPECT_EQ(loss_factor({}, {3, 63.0, 1.5, 63.0}, 0.1), least_loss_factor);
  EXPECT_EQ(loss_factor({}, {3, 64.0, 1.5, 63.0}, 0.1), least_loss_factor);
  EXPECT_EQ(loss_factor({}, {3, 1.5, 1.5, 63.0}, 0.1), least_loss_factor);
  EXPECT_GT(loss_factor({}, {3, 30.0, 1.5, 63.0}, 0.0), 0.999);
}

// Thrust over that of the wind: 4 a F (1 - a) up to a = 0.4, Buhl's parabola above; kappa is this
// over 4 F (1 - a)^2, because the thrust of the blade grows with the square of the wind there.
double kappa_of(double thrust, double induction, double loss) {
  return thrust / (4.0 * loss * (1.0 - induction) * (1.0 - induction));
}

TEST(Losses, HaveTheSlopeOfTheirDifferences) {
  const AnnulusPlace place{3, 50.0, 1.5, 63.0};
  for (const Losses losses : {Losses{true, false}, Losses{true, true}}) {
    for (const double angle : {0.3, 1.2, 2.0, -0.2}) {
      double slope;
      loss_factor(losses, place, angle, slope);
      constexpr double h = 1e-5;
      EXPECT_NEAR(slope,
                  (loss_factor(losses, place, angle + h) - loss_factor(losses, place, angle - h)) /
                      (2.0 * h),
                  1e-8);
    }
  }
}

TEST(Momentum, ThrustOfThreeQuartersInducesAQuarter) {
  EXPECT_NEAR(axial_induction(kappa_of(0.75, 0.25, 1.0), 1.0), 0.25, 1e-15);
}

TEST(Momentum, BuhlsParabolaHoldsForHeavyLoads) {
  for (const double loss : {1.0, 0.8, 0.3}) {
    for (const double a : {0.4, 0.5, 0.7, 0.95}) {
      const double thrust =
          8.0 / 9.0 + (4.0 * loss - 40.0 / 9.0) * a + (50.0 / 9.0 - 4.0 * loss) * a * a;
      EXPECT_NEAR(axial_induction(kappa_of(thrust, a, loss), loss), a, 1e-13) << loss;
    }
  }
  EXPECT_NEAR(8.0 / 9.0 + (4.0 - 40.0 / 9.0) * 0.5 + (50.0 / 9.0 - 4.0) * 0.25, 1.055556,
              last_of_six);
}

TEST(Momentum, BuhlsRootHasNoGapWhereItsDenominatorVanishes) {
  const double loss = 0.6;
  const double pole = (25.0 / 9.0 - 2.0 * loss) / (2.0 * loss);
  const double below = axial_induction(pole - 1e-3, loss);
  const double above = axial_induction(pole + 1e-3, loss);
  EXPECT_NEAR(axial_induction(pole, loss), 0.5 * (below + above), 1e-3 * (above - below));
}

// A flat plate with some drag, at all angles.
LiftDrag plate(double alpha) {
  return {2.0 * std::sin(2.0 * alpha), 0.05 + std::pow(std::sin(alpha), 2)};
}

// The inflow angle must be that of the wind with the induction it gives.
double mismatch(const BladeElement& e, const Induction& i) {
  const double angle = std::atan2(e.axial * (1.0 - i.axial), e.tangential * (1.0 + i.tangential));
  return std::remainder(angle - i.inflow_angle, 2.0 * pi);
}

TEST(Balance, InflowAngleAndInductionAgreeInAllBrackets) {
  bool below = false;
  bool behind = false;
  for (const bool drag : {true, false}) {
    for (const double axial : {0.5, 3.0, 12.0, 40.0}) {
      for (const double tangential : {-30.0, 2.0, 30.0, 80.0}) {
        // a rotor that turns backwards without drag may have no balance
        if (!drag && tangential < 0.0) continue;
        for (int k = -6; k <= 6; ++k) {
          const double twist = 0.1 * k;
          BladeElement e = element(axial, tangential, twist);
          e.drag_induces = drag;
          const Induction i = solve_induction(e, plate);
          ASSERT_TRUE(i.found) << axial << ' ' << tangential << ' ' << twist;
          EXPECT_NEAR(induction_residual(e, plate, i.inflow_angle), 0.0, 1e-9);
          EXPECT_NEAR(mismatch(e, i), 0.0, 1e-8) << axial << ' ' << tangential << ' ' << twist;
          below = below || i.inflow_angle < 0.0;
          behind = behind || i.inflow_angle > 0.5 * pi;
        }
      }
    }
  }
  EXPECT_TRUE(below);
  EXPECT_TRUE(behind);
}

TEST(Balance, WindFromBehindIsTheMirrorImage) {
  const Induction ahead = solve_induction(element(8.0, 60.0, 0.05), plate);
  const Induction back = solve_induction(element(-8.0, 60.0, -0.05), plate);
  EXPECT_EQ(back.inflow_angle, -ahead.inflow_angle);
  EXPECT_EQ(back.axial, ahead.axial);
  EXPECT_EQ(back.tangential, ahead.tangential);
}

TEST(Balance, NothingIsInducedWhereARotorStandsOrWindIsMissing) {
  for (const auto& [axial, tangential] : {std::pair{8.0, 0.0}, {0.0, 50.0}, {0.0, 0.0}}) {
    const Induction i = solve_induction(element(axial, tangential, 0.1), plate);
    EXPECT_FALSE(i.found);
    EXPECT_EQ(i.axial, 0.0);
    EXPECT_EQ(i.tangential, 0.0);
  }
}

TEST(Skew, PittAndPetersMoveInductionDownwind) {
  const double skew = wake_skew(0.3, 0.25);
  EXPECT_NEAR(skew, 0.345, 1e-15);
  const double part = 15.0 * pi / 32.0 * 0.7 * std::tan(0.1725);
  EXPECT_NEAR(skew_factor(skew, 0.7, 0.0), 1.0 + part, 1e-15);
  EXPECT_NEAR(skew_factor(skew, 0.7, pi), 1.0 - part, 1e-15);
  EXPECT_NEAR(skew_factor(2.5, 1.0, 0.0), 1.0 + 15.0 * pi / 32.0, 1e-15);
}

// R = 63 m, U = 8 m/s, mean induction 0.3, at 0.7 R
InflowTimes example_times() { return inflow_times(0.3, 8.0, 63.0, 0.7); }

TEST(DynamicInflow, TimesFollowOye) {
  EXPECT_NEAR(example_times().slow, 14.200820, last_of_six);
  EXPECT_NEAR(example_times().fast, 3.729135, last_of_six);
  EXPECT_EQ(inflow_times(0.9, 8.0, 63.0, 0.7).slow, inflow_times(0.5, 8.0, 63.0, 0.7).slow);
}

TEST(DynamicInflow, AStepIsFollowedExactlyWhateverTheStepInTime) {
  const std::pair<double, double> reference[] = {
      {1.0, 0.144507}, {2.0, 0.261192}, {5.0, 0.498830}, {10.0, 0.700432}, {20.0, 0.865205}};
  const Induced one = Induced::Ones();
  for (const double step : {0.01, 1.0}) {
    InflowState state;
    double time = 0.0;
    for (const auto& [until, value] : reference) {
      for (; time < until - 0.5 * step; time += step)
        state = state.after(step, example_times(), one, one);
      EXPECT_NEAR(state.induced[0], value, last_of_six) << step;
    }
  }
}

TEST(DynamicInflow, InputsThatGrowLinearlyAreFollowedExactly) {
  const Induced begin(1.0, -0.5);
  const Induced end(1.4, 0.3);
  InflowState fine{Induced(0.2, 0.1), Induced(0.3, -0.2)};
  const InflowState coarse = fine.after(2.0, example_times(), begin, end);
  for (int i = 0; i < 8; ++i) {
    fine = fine.after(0.25, example_times(), begin + i / 8.0 * (end - begin),
                      begin + (i + 1) / 8.0 * (end - begin));
  }
  EXPECT_LT((fine.induced - coarse.induced).norm(), 1e-14);
  EXPECT_LT((fine.reduced - coarse.reduced).norm(), 1e-14);
}

TEST(DynamicInflow, NothingChangesInTheSteadyState) {
  const Induced w(-2.0, 0.3);
  const InflowState from_rest = InflowState().after(3.0, example_times(), w, w);
  EXPECT_LT((from_rest.induced - inflow_response(3.0, example_times()) * w).norm(), 1e-15);
  const InflowState later = InflowState::steady(w).after(3.0, example_times(), w, w);
  EXPECT_LT((later.induced - w).norm(), 1e-15);
  EXPECT_LT((later.reduced - 0.4 * w).norm(), 1e-15);
}

}  // namespace
}  // namespace culm::rotor
