#include <culm/analysis/failure_trend.hpp>

#include <gtest/gtest.h>

#include <utility>

namespace culm::analysis {
namespace {

// Adds failures that approach a level, each by a share of what is left; says how many it took.
int failures_until_end(FailureTrend& trend, double limit, double share, double final_level) {
  double level = 0.0;
  for (int i = 1; i <= 40; ++i) {
    trend.add(level);
    trend.add(level);  // cut back twice
    if (const auto end = trend.end(final_level)) {
      EXPECT_NEAR(*end, limit, 0.1 * (limit - level)) << share;
      return i;
    }
    level += share * (limit - level);
  }
  return 0;
}

TEST(FailureTrend, FindsTheLevelThatGainsLeadTo) {
  for (const auto& [share, failures] : {std::pair{0.3, 13}, {0.5, 7}, {0.9, 7}}) {
    FailureTrend trend;
    EXPECT_EQ(failures_until_end(trend, 0.7, share, 1.0), failures) << share;
  }
}

TEST(FailureTrend, LetsGoOnWhereTheFinalLevelIsWithinReach) {
  FailureTrend trend;
  EXPECT_EQ(failures_until_end(trend, 1.01, 0.5, 1.0), 0);
}

TEST(FailureTrend, LetsGoOnWhereGainsDoNotShrink) {
  FailureTrend steady;
  for (int i = 0; i < 40; ++i) {
    steady.add(0.01 * i);
    EXPECT_FALSE(steady.end(1.0));
  }
  FailureTrend halving;  // the first increment was far too large
  for (int i = 0; i < 40; ++i) {
    halving.add(0.3);
    EXPECT_FALSE(halving.end(1.0));
  }
}

// Levels of a sheared foil beyond its first wrinkles.
TEST(FailureTrend, FindsAnEndInGainsThatJump) {
  FailureTrend trend;
  int failures = 0;
  for (const double level : {1.05, 1.05625, 1.0609, 1.0645, 1.0653, 1.0672, 1.0674, 1.0675, 1.06757,
                             1.0676, 1.06764, 1.06765}) {
    ++failures;
    trend.add(level);
    if (trend.end(2.0)) break;
  }
  EXPECT_LE(failures, 8);
  EXPECT_NEAR(trend.end(2.0).value_or(0.0), 1.0677, 1e-3);
}

TEST(FailureTrend, SeesARecovery) {
  FailureTrend trend;
  double level = 0.0;
  for (int i = 0; i < 12; ++i, level += 0.5 * (0.5 - level)) trend.add(level);
  trend.add(level + 0.1);
  EXPECT_FALSE(trend.end(1.0));
}

TEST(FailureTrend, GoesOnFromASnapshot) {
  FailureTrend trend;
  ASSERT_GT(failures_until_end(trend, 0.5, 0.5, 1.0), 0);
  Snapshot snapshot;
  trend.save(snapshot);
  FailureTrend again;
  again.restore(snapshot);
  EXPECT_EQ(again.end(1.0), trend.end(1.0));
}

}  // namespace
}  // namespace culm::analysis
