#include <culm/base/error.hpp>
#include <culm/base/stop_signal.hpp>

#include <atomic>
#include <csignal>
#include <ctime>
#include <string>

namespace culm {
namespace {

// The only way from a signal handler to the program: without locks.
std::atomic<int> received = 0;
std::atomic<double> received_at = 0.0;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<double>::is_always_lock_free);

// Handlers may ask the system for the time, and not the library.
double now() noexcept {
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

void note_stop_signal(int number) noexcept {
  received_at = now();
  received = number;
}

int stop_signal() noexcept { return received; }

std::optional<double> since_stop_signal() noexcept {
  if (received == 0) return {};
  return now() - received_at;
}

void stop_if_asked(double grace, const char* what) {
  const std::optional<double> since = since_stop_signal();
  if (!since || *since < grace) return;
  throw Stopped(std::string("stopped: signal ") +
                (stop_signal() == SIGTERM ? "SIGTERM" : "SIGUSR1") + ", " + what);
}

}  // namespace culm
