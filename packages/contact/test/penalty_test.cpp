#include <culm/contact/penalty.hpp>

#include <gtest/gtest.h>

namespace culm::contact {
namespace {

const Penalty laws[] = {{2e3, 0.0, 0.0}, {2e3, 0.3, 0.0}};
// above, within the smoothing, below, through all of it, and at rest
const double ways[][2] = {{-1.0, -0.5}, {-0.1, 0.05}, {0.2, 0.7},  {-0.4, 0.9},
                          {0.9, -0.4},  {0.1, 0.1},   {-0.1, 0.4}, {0.05, -0.3}};

TEST(Penalty, PressureIsDerivativeOfTheEnergyAndSlopeOfThePressure) {
  for (const Penalty& law : laws) {
    for (const double depth : {-0.4, -0.1, 0.05, 0.2, 0.7}) {
      const double h = 1e-6;
      EXPECT_NEAR((law.energy(depth + h) - law.energy(depth - h)) / (2.0 * h), law.pressure(depth),
                  1e-5);
      EXPECT_NEAR((law.pressure(depth + h) - law.pressure(depth - h)) / (2.0 * h), law.slope(depth),
                  1e-5);
    }
  }
}

TEST(Penalty, IsLinearBeyondTheSmoothing) {
  for (const Penalty& law : laws) EXPECT_DOUBLE_EQ(law.pressure(0.7), 1400.0);
}

TEST(Penalty, ConservingStepStoresWhatItTakes) {
  for (const Penalty& law : laws) {
    for (const auto& way : ways) {
      for (double share = 1.0; share > 1e-13; share *= 0.1) {
        const double next = way[0] + share * (way[1] - way[0]);
        const PenaltyResponse found = respond(law, way[0], next, Stencil::midpoint(0.1));
        const double stored = law.energy(next) - law.energy(way[0]);
        EXPECT_NEAR(found.elastic * (next - way[0]), stored, 1e-15 * law.stiffness);
        EXPECT_EQ(found.pressure, found.elastic);
      }
    }
  }
}

TEST(Penalty, TangentIsDerivativeOfThePressure) {
  for (const Stencil& stencil :
       {Stencil::statics(), Stencil::midpoint(0.4), Stencil{0.4, 0.5, 0.75}}) {
    for (Penalty law : laws) {
      for (const double damping : {0.0, 0.3}) {
        law.damping = damping;
        for (const auto& way : ways) {
          const double h = 1e-6;
          const double difference = (respond(law, way[0], way[1] + h, stencil).pressure -
                                     respond(law, way[0], way[1] - h, stencil).pressure) /
                                    (2.0 * h);
          EXPECT_NEAR(respond(law, way[0], way[1], stencil).tangent, difference, 2e-2) << way[0];
        }
      }
    }
  }
}

// Neither damping nor a weight of the end gives energy or pulls.
TEST(Penalty, OnlyTakesEnergyAndNeverPulls) {
  for (Penalty law : laws) {
    law.damping = 5.0;
    for (const auto& way : ways) {
      const PenaltyResponse found = respond(law, way[0], way[1], {0.4, 0.5, 0.75});
      EXPECT_GE(found.pressure, 0.0);
      EXPECT_GE((found.pressure - found.elastic) * (way[1] - way[0]), 0.0);
      EXPECT_GE(found.elastic * (way[1] - way[0]) - law.energy(way[1]) + law.energy(way[0]),
                -1e-11);
    }
  }
}

}  // namespace
}  // namespace culm::contact
