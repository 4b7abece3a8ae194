#include <culm/base/cycle_clock.hpp>

#ifdef __x86_64__
#include <x86intrin.h>

#include <cstdint>
#include <fstream>
#include <string>
#endif

namespace culm {

using Clock = std::chrono::steady_clock;

#ifdef __x86_64__
namespace {

struct Moment {
  std::uint64_t count;
  Clock::time_point time;
};

// Both clocks at once: of some readings the one that was disturbed least.
Moment read_both() {
  Moment best{};
  std::uint64_t shortest = UINT64_MAX;
  for (int reading = 0; reading < 8; ++reading) {
    const std::uint64_t before = __rdtsc();
    const Clock::time_point time = Clock::now();
    const std::uint64_t after = __rdtsc();
    if (after - before >= shortest) continue;
    shortest = after - before;
    best = {before + (after - before) / 2, time};
  }
  return best;
}

class CycleClock {
 public:
  CycleClock() {
    // The system tests whether the counters of all processors agree and never change their rate.
    std::ifstream source("/sys/devices/system/clocksource/clocksource0/current_clocksource");
    std::string name;
    if (!(source >> name) || name != "tsc") return;
    start_ = read_both();
    while (Clock::now() - start_.time < std::chrono::microseconds(200)) {
    }
    const Moment end = read_both();
    const std::chrono::duration<double, Clock::period> passed = end.time - start_.time;
    if (end.count > start_.count) {
      ticks_per_count_ = passed.count() / static_cast<double>(end.count - start_.count);
    }
  }

  Clock::time_point now() const {
    if (ticks_per_count_ == 0.0) return Clock::now();
    // signed: the counter of another processor may be behind by some cycles
    const auto passed = static_cast<std::int64_t>(__rdtsc() - start_.count);
    const double ticks = ticks_per_count_ * static_cast<double>(passed);
    return start_.time + Clock::duration(static_cast<Clock::rep>(ticks));
  }

 private:
  Moment start_{};
  double ticks_per_count_ = 0.0;  // zero: the counter is no clock
};

}  // namespace

Clock::time_point cycle_time() {
  static const CycleClock clock;
  return clock.now();
}
#else
Clock::time_point cycle_time() { return Clock::now(); }
#endif

}  // namespace culm
