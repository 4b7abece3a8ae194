#include "checkpoints.hpp"

#include "shared_checkpoint.hpp"

#include <algorithm>
#include <csignal>
#include <utility>

namespace culm::simulation {
namespace {

// What ranks tell each other; the largest one counts, and a signal is its number above `signalled`.
constexpr int nothing = 0;
constexpr int due = 1;
constexpr int time_over = 2;
constexpr int signalled = 100;

constexpr double longest_deafness = 0.05;  // s
constexpr double largest_share = 0.01;     // of the time of a run, for writing checkpoints

}  // namespace

std::filesystem::path checkpoint_path(const std::filesystem::path& folder) {
  return folder / "run.checkpoint";
}

Checkpoints::Checkpoints(const parallel::Comm& comm, std::filesystem::path folder, bool active,
                         double interval, const StopRequest& request)
    : comm_(comm),
      folder_(std::move(folder)),
      active_(active),
      interval_(interval),
      request_(request),
      last_step_(request.elapsed()),
      begun_(last_step_),
      due_(last_step_ + interval) {}

void Checkpoints::begin_early() {
  is_early_ = true;
  due_ = last_step_;
}

Checkpoints::Demand Checkpoints::demand() {
  const double now = request_.elapsed();
  longest_step_ = std::max(longest_step_, now - last_step_);
  last_step_ = now;
  int found = nothing;
  // the clock of one rank counts
  if (comm_.is_root() && active_ && now >= due_) found = due;
  if (comm_.is_root() && request_.is_time_over(longest_step_)) found = time_over;
  if (now - listened_ > longest_deafness) {
    listened_ = now;
    StopRequest::listen();  // a controller or a partner's library may have taken the signals
  }
  if (request_.signal() != 0) found = signalled + request_.signal();
  found = comm_.max(found);
  if (found > due) reason_ = found;
  if (found == nothing) return Demand::none;
  return found == due ? Demand::checkpoint : Demand::stop;
}

void Checkpoints::write(const Snapshot& snapshot) {
  const double before = request_.elapsed();
  write_shared_checkpoint(comm_, checkpoint_path(folder_), snapshot);
  const double now = request_.elapsed();
  const double rest = is_early_ ? std::min(interval_, now - begun_) : interval_;
  due_ = now + (interval_ > 0.0 ? std::max(rest, (now - before) / largest_share) : 0.0);
}

std::string Checkpoints::farewell() const {
  const std::string reason = reason_ == time_over             ? "the time allowed is over"
                             : reason_ == signalled + SIGTERM ? "signal SIGTERM"
                                                              : "signal SIGUSR1";
  return "stopped: " + reason + "\n" +
         (active_ ? "Go on with: " + way_on()
                  : "There is no checkpoint, because the deck switches them off.");
}

}  // namespace culm::simulation
