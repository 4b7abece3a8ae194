// The lag of circulation behind the downwash.
#include <culm/strip/lag.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace culm::strip {
namespace {

// T x' + x = u with T = 0.35 s, x(0) = 0.2 and u from 1 to 1.4 within 0.1 s, in equal steps.
double after_ramp(int steps) {
  const double h = 0.1 / steps;
  double x = 0.2;
  for (int n = 0; n < steps; ++n)
    x = lag_step(x, 1.0 + 0.4 * (n + 0.5) / steps, lag_share(h / 0.35));
  return x;
}

// C26. A step takes what it follows as constant, so a constant is exact and a ramp of second order.
TEST(Lag, FollowsARampToSecondOrder) {
  const double exact = 0.450886376;
  EXPECT_NEAR(after_ramp(1), 1.2 - std::exp(-0.1 / 0.35), 1e-14);
  EXPECT_NEAR(after_ramp(1), exact, 3e-3);
  EXPECT_NEAR((after_ramp(1) - exact) / (after_ramp(2) - exact), 4.0, 0.01);
  EXPECT_NEAR(after_ramp(1000), exact, 1e-8);
}

}  // namespace
}  // namespace culm::strip
