#include <culm/model/turn_law.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::model {
namespace {

TEST(TurnLaw, OfOrderOneIsTheSine) {
  const TurnLaw law(1);
  EXPECT_NEAR(law.greatest_moment(), 0.25 * std::numbers::pi, 1e-8);
  for (const double turn : {0.01, 0.2, 0.34, 0.6}) {
    const TurnErrors e = law.errors(turn);
    EXPECT_NEAR(e.energy, std::pow(std::tan(turn), 2), 1e-9);
    EXPECT_NEAR(e.moment, 1.0 - std::sin(2.0 * turn) / (2.0 * turn), 1e-9);
    EXPECT_NEAR(e.stiffness, 1.0 - std::cos(2.0 * turn), 1e-9);
    // curved without load: compliance and stiffness of what is added
    const TurnErrors curved = law.errors(turn, turn);
    EXPECT_NEAR(curved.energy, e.energy, 1e-12);
    EXPECT_NEAR(curved.moment, std::pow(std::sin(turn), 2), 1e-9);
    EXPECT_NEAR(curved.stiffness, curved.moment, 1e-9);
  }
}

// W = 1/2 Δ² (1 - a Δ⁴): the energy at a moment is off by 5 a Δ⁴, the moment by 3 a, the stiffness
// by 15 a; a of order 2 from F = sin(Δ/2) (4 - cos(Δ/2)) 2/3, of order 3 with inner nodes at rest
TEST(TurnLaw, OfHigherOrdersIsOfFourthOrder) {
  for (const auto& [order, a] : {std::pair{2, 1.0 / 240.0}, std::pair{3, 5.0 / 10368.0}}) {
    const double turn = 0.1;
    const TurnErrors e = TurnLaw(order).errors(turn);
    const double fourth = a * std::pow(turn, 4);
    EXPECT_NEAR(e.energy, 5.0 * fourth, 0.02 * e.energy) << order;
    EXPECT_NEAR(e.moment, 3.0 * fourth, 0.02 * e.moment) << order;
    EXPECT_NEAR(e.stiffness, 15.0 * fourth, 0.02 * e.stiffness) << order;
  }
}

// what a full circle of eight elements errs by: 0.475 % and 0.070 % too much turn
TEST(TurnLaw, TellsTheErrorsOfARollUp) {
  const double eighth = 0.25 * std::numbers::pi;
  EXPECT_NEAR(TurnLaw(2).errors(eighth).moment, 4.64e-3, 1e-5);
  EXPECT_NEAR(TurnLaw(3).errors(eighth).moment, 7.00e-4, 1e-6);
}

TEST(TurnLaw, FindsTheTurnOfAnError) {
  for (const int order : {1, 2, 3}) {
    const TurnLaw law(order);
    EXPECT_NEAR(law.errors(law.turn_with(0.04)).energy, 0.04, 1e-6) << order;
    EXPECT_LT(law.turn_with(0.04), law.greatest_moment()) << order;
    EXPECT_NEAR(law.errors(law.greatest_moment()).stiffness, 1.0, 1e-6) << order;
    EXPECT_EQ(law.errors(0.0).energy, 0.0) << order;
  }
}

}  // namespace
}  // namespace culm::model
