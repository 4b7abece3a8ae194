#include <culm/analysis/path_events.hpp>

#include <gtest/gtest.h>

namespace culm::analysis {
namespace {

PathPoint point(double level, double slope, int sign) {
  PathPoint point;
  point.level = level;
  point.tangent.level = slope;
  point.determinant = {sign, 0.0};
  return point;
}

// Of x^3 - 3 x, whose slope is 3 x^2 - 3.
TEST(PathEvents, LimitPointsLieWhereACubicTurns) {
  const auto one = find_events(point(0.0, -3.0, -1), point(2.0, 9.0, 1), 2.0);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].kind, PathEventKind::limit_point);
  EXPECT_NEAR(one[0].level, -2.0, 1e-12);
}

// From -1.5 to 1.5: there and back, which signs do not show.
TEST(PathEvents, LevelsThatFallBetweenRisingEndsHaveTwoLimitPoints) {
  const auto events = find_events(point(1.125, 3.75, 1), point(-1.125, 3.75, 1), 3.0);
  ASSERT_EQ(events.size(), 2u);
  for (const PathEvent& event : events) EXPECT_EQ(event.kind, PathEventKind::limit_point);
  EXPECT_NEAR(events[0].level, 2.0, 1e-12);
  EXPECT_NEAR(events[1].level, -2.0, 1e-12);
}

}  // namespace
}  // namespace culm::analysis
