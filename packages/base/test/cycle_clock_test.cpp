#include <culm/base/cycle_clock.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

using namespace culm;

namespace {

TEST(CycleClock, TellsTheLengthOfAnInterval) {
  cycle_time();  // measures its rate
  const auto outside = std::chrono::steady_clock::now();
  const auto begin = cycle_time();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const std::chrono::duration<double> inside = cycle_time() - begin;
  const std::chrono::duration<double> around = std::chrono::steady_clock::now() - outside;
  EXPECT_GE(inside.count(), 0.02 * (1.0 - 1e-3));
  EXPECT_LE(inside.count(), around.count() * (1.0 + 1e-3));
}

TEST(CycleClock, NeverGoesBack) {
  auto last = cycle_time();
  for (int call = 0; call < 1000; ++call) {
    const auto now = cycle_time();
    EXPECT_GE(now, last);
    last = now;
  }
}

}  // namespace
