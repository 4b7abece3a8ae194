#include <culm/base/error.hpp>
#include <culm/base/stop_signal.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/units.hpp>
#include <culm/simulation/stop_request.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <vector>

namespace culm::simulation {
namespace {

constexpr std::array signals = {SIGTERM, SIGUSR1};

// How many listen.
int living = 0;

// Who sent the signal.
volatile std::sig_atomic_t sender = 0;

void note(int signal, siginfo_t* info, void* /*context*/) {
  sender = info->si_pid;
  note_stop_signal(signal);
  StopRequest::listen();  // to a second one, too
}

void set_handlers(struct sigaction action) {
  sigemptyset(&action.sa_mask);
  for (const int signal : signals) sigaction(signal, &action, nullptr);
}

std::optional<double> find_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// [D-]H:M:S or M:S
std::optional<double> find_clock_time(std::string_view text) {
  double days = 0.0;
  const auto dash = text.find('-');
  if (dash != std::string_view::npos) {
    const auto number = find_number(text.substr(0, dash));
    if (!number) return {};
    days = *number;
    text.remove_prefix(dash + 1);
  }
  std::vector<double> parts;
  while (true) {
    const auto colon = text.find(':');
    const auto number = find_number(text.substr(0, colon));
    // what follows a larger unit is less than one of it
    if (!number || *number < 0.0 || (!parts.empty() && *number >= 60.0)) return {};
    parts.push_back(*number);
    if (colon == std::string_view::npos) break;
    text.remove_prefix(colon + 1);
  }
  if (parts.size() != 3 && (parts.size() != 2 || dash != std::string_view::npos)) return {};
  double seconds = 0.0;
  for (const double part : parts) seconds = 60.0 * seconds + part;
  return 86400.0 * days + seconds;
}

// A number and perhaps a unit of time.
std::optional<double> find_duration(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return {};
  const std::string_view name = trim(text.substr(static_cast<std::size_t>(end - text.data())));
  if (name.empty()) return value;
  const auto unit = deck::find_unit(name);
  if (!unit || !unit->same_dimension(*deck::find_unit("s"))) return {};
  return unit->to_si(value);
}

}  // namespace

StopRequest::StopRequest(std::optional<double> walltime) : walltime_(walltime) {
  if (living++ > 0) return;  // what came since the first one began counts
  note_stop_signal(0);
  sender = 0;
  listen();
}

void StopRequest::listen() {
  struct sigaction action {};
  action.sa_sigaction = note;
  action.sa_flags = SA_SIGINFO | SA_RESTART;  // reading and writing go on
  set_handlers(action);
}

StopRequest::~StopRequest() {
  if (--living > 0) return;
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  set_handlers(action);
}

int StopRequest::signal() const { return stop_signal(); }

bool StopRequest::is_ended_by(int process) { return stop_signal() == SIGTERM && sender == process; }

double StopRequest::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool StopRequest::is_time_over(double ahead) const {
  return walltime_ && elapsed() + ahead >= *walltime_;
}

std::optional<double> find_walltime(const std::string& text) {
  if (text.empty()) return {};
  const std::string_view trimmed = trim(text);
  auto seconds = find_clock_time(trimmed);
  if (!seconds) seconds = find_duration(trimmed);
  if (!seconds || !(*seconds > 0.0) || !std::isfinite(*seconds)) {
    throw UsageError(
        "--walltime needs a time such as 1:30:00, 2-00:00:00, '90 min' or '1.5 h', "
        "got '" +
        text + "'");
  }
  return seconds;
}

}  // namespace culm::simulation
