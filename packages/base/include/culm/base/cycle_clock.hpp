#pragma once

#include <chrono>

namespace culm {

/// The time of the steady clock, told in a third of its cost where the system itself takes the
/// counter of the processor for its clock; else the steady clock. The rate of the counter is
/// measured in the first call, which takes a fifth of a millisecond, to about 1e-4 of an interval.
std::chrono::steady_clock::time_point cycle_time();

}  // namespace culm
