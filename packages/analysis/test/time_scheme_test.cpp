#include "motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace culm::analysis {
namespace {

double energy(const Motion& motion) {
  const model::State& s = motion.state;
  return motion.system->energies(s.next, motion.system->kinetic_energy(s.velocity)).total();
}

// largest difference of a coordinate at the end of a time
double difference(const Motion& a, const Motion& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.state.next.size(); ++i) {
    largest = std::max(largest, std::abs(a.state.next[i] - b.state.next[i]));
  }
  return a.comm.max(largest);
}

using Make = std::function<std::unique_ptr<TimeScheme>()>;

std::unique_ptr<TimeScheme> conserving() { return std::make_unique<ConservingScheme>(); }

TEST(ConservingScheme, KeepsEnergyAndMomentaForAnySequenceOfSteps) {
  Motion chain(build_free_chain, conserving());
  const auto momentum = [&] {
    return chain.system->momentum(chain.state.next, chain.state.velocity);
  };
  const double first = energy(chain);
  const model::Momentum start = momentum();
  for (const double h : {0.02, 0.05, 0.01, 0.03, 0.07, 0.02}) chain.advance(h, 3);
  EXPECT_NEAR(energy(chain), first, 1e-11 * first);
  EXPECT_LT((momentum().linear - start.linear).norm(), 1e-11 * start.linear.norm());
  EXPECT_LT((momentum().angular - start.angular).norm(), 1e-11 * start.angular.norm());
}

TEST(ConservingScheme, RunsBackToWhereItStarted) {
  Motion chain(build_free_chain, conserving());
  chain.system->synchronise(chain.state);
  const model::Coordinates start = chain.state.next;
  chain.advance(0.02, 10);
  for (double& v : chain.state.velocity) v = -v;
  chain.advance(0.02, 10);
  chain.system->synchronise(chain.state);
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(chain.state.next[i], start[i], 1e-9);
}

class Order : public ::testing::TestWithParam<Make> {};

TEST_P(Order, IsTwo) {
  const auto run = [](int steps) {
    auto top = std::make_unique<Motion>(build_top, GetParam()());
    top->advance(0.02 / steps, steps);
    return top;
  };
  const auto exact = run(3200);
  const double coarse = difference(*run(100), *exact);
  const double fine = difference(*run(200), *exact);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Order,
                         ::testing::Values(Make(conserving), Make([] {
                                             return std::make_unique<GeneralisedAlphaScheme>(0.8);
                                           })));

TEST(GeneralisedAlpha, ConstantOfTheTrapezoidalRuleWithoutDamping) {
  EXPECT_DOUBLE_EQ(GeneralisedAlphaScheme(1.0).error_constant(),
                   ConservingScheme().error_constant());
}

}  // namespace
}  // namespace culm::analysis
