#include <culm/analysis/path_pace.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace culm::analysis {
namespace {

TEST(PathPace, IsThatOfTheLastSteps) {
  PathPace pace;
  for (int i = 0; i <= 4; ++i) pace.add(0.0, -1.0 * i);
  EXPECT_FALSE(pace.steps_to_displacement(-10.0));
  for (int i = 1; i <= 20; ++i) pace.add(0.1 * i, -4.0 - 0.01 * i);
  EXPECT_EQ(pace.steps_to_displacement(-4.405), 21.0);  // 0.205 m, 0.01 m each
  EXPECT_EQ(pace.steps_to_level(-1.0), std::numeric_limits<double>::infinity());
}

TEST(PathPace, IsKeptInSnapshots) {
  PathPace pace;
  for (int i = 0; i <= PathPace::steps; ++i) pace.add(i, 0.0);
  Snapshot snapshot;
  pace.save(snapshot);
  PathPace other;
  other.restore(snapshot);
  EXPECT_EQ(other.steps_to_level(12.0), 2.0);
}

}  // namespace
}  // namespace culm::analysis
