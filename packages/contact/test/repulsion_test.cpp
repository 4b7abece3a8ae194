#include <culm/contact/repulsion.hpp>

#include <gtest/gtest.h>

namespace culm::contact {
namespace {

const Repulsion law{2.0, 30.0, 0.0};
// squares of distances at both ends of a step: inside, into the reach, out of it, beyond it, at
// rest
const double squares[][2] = {{3.0, 3.5}, {4.5, 3.2}, {3.2, 4.5},
                             {4.2, 5.0}, {3.6, 3.6}, {4.0, 3.9}};

TEST(Repulsion, ConservingStepStoresWhatItTakes) {
  for (const auto& way : squares) {
    for (double share = 1.0; share > 1e-13; share *= 0.1) {
      const double next = way[0] + share * (way[1] - way[0]);
      const RepulsionResponse found = respond(law, way[0], next, Stencil::midpoint(0.1));
      EXPECT_NEAR(found.elastic * (next - way[0]), law.energy(next) - law.energy(way[0]),
                  1e-15 * law.energy(0.0));
      EXPECT_EQ(found.stress, found.elastic);
    }
  }
}

TEST(Repulsion, TangentIsDerivativeOfTheStress) {
  for (const Stencil& stencil :
       {Stencil::statics(), Stencil::midpoint(0.4), Stencil{0.4, 0.5, 0.75}}) {
    for (const double damping : {0.0, 0.3}) {
      Repulsion damped = law;
      damped.damping = damping;
      for (const auto& way : squares) {
        const double h = 1e-6;
        const double difference = (respond(damped, way[0], way[1] + h, stencil).stress -
                                   respond(damped, way[0], way[1] - h, stencil).stress) /
                                  (2.0 * h);
        EXPECT_NEAR(respond(damped, way[0], way[1], stencil).tangent, difference, 2e-6) << way[0];
      }
    }
  }
}

TEST(Repulsion, OnlyTakesEnergyAndNeverPulls) {
  Repulsion damped = law;
  damped.damping = 5.0;
  for (const auto& way : squares) {
    const RepulsionResponse found = respond(damped, way[0], way[1], {0.4, 0.5, 0.75});
    EXPECT_LE(found.stress, 0.0);
    EXPECT_GE((found.stress - found.elastic) * (way[1] - way[0]), 0.0);
    EXPECT_GE(found.elastic * (way[1] - way[0]) - damped.energy(way[1]) + damped.energy(way[0]),
              -1e-11);
  }
}

}  // namespace
}  // namespace culm::contact
