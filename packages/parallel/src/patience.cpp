#include <culm/parallel/patience.hpp>

#include <thread>

namespace culm::parallel {
namespace {

constexpr double busy = 1e-3;  // [s]
constexpr auto rest = std::chrono::microseconds(50);

}  // namespace

double Patience::waited() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool Patience::is_long() const { return waited() > busy; }

void Patience::pause() const {
  if (is_long()) {
    std::this_thread::sleep_for(rest);
  } else {
    std::this_thread::yield();
  }
}

}  // namespace culm::parallel
