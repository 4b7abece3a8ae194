#include <culm/base/stop_signal.hpp>
#include <culm/coupling/channel.hpp>

#include <csignal>

namespace culm::coupling {

void Channel::heed_signal(double waited) const {
  if (!heeds_signals_ || stop_signal() != SIGTERM) return;
  constexpr double grace = 10.0;  // s
  if (waited >= grace) stop_if_asked(grace, "while a partner had not answered yet");
}

}  // namespace culm::coupling
