#include <culm/base/error.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/replay.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::coupling {

using port::Quantity;

namespace {

// Of a window: how near two times may be to count as one.
constexpr double same_time = 1e-6;

}  // namespace

void ReplayedPartner::begin(const Beginning& beginning) {
  if (beginning.window > 0) {
    throw UsageError("a replay begins at the beginning: run it anew instead of going on");
  }
  if (record_.beginning.reference != beginning.reference) {
    double largest = 0.0;
    const std::size_t count =
        std::min(record_.beginning.reference.size(), beginning.reference.size());
    for (std::size_t i = 0; i < count; ++i) {
      largest =
          std::max(largest, std::abs(record_.beginning.reference[i] - beginning.reference[i]));
    }
    if (record_.beginning.points() != beginning.points() || largest > 1e-9) {
      throw UsageError(fmt::format(
          "{}: port '{}' had {} points there and has {} here, up to {:.2g} m away from "
          "them",
          file_, beginning.port, record_.beginning.points(), beginning.points(), largest));
    }
  }
}

double ReplayedPartner::latest_end(double start) const {
  (void)start;
  return next_ < record_.windows.size() ? record_.windows[next_].accepted.end
                                        : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd ReplayedPartner::loads(const Window& window) {
  if (next_ == record_.windows.size()) {
    throw PartnerError(
        fmt::format("{}: the record ends at {:g} s, the motion goes on", file_, window.start));
  }
  const Window& then = record_.windows[next_].accepted;
  const double expected = moved_.empty() ? then.start : reached_;
  if (std::abs(window.start - expected) > same_time * then.length()) {
    throw PartnerError(fmt::format("{}: the record goes on at {:g} s, the motion at {:g} s", file_,
                                   expected, window.start));
  }
  const std::vector<double>& loads = then.loads;
  return Eigen::Map<const Eigen::VectorXd>(loads.data(), static_cast<Eigen::Index>(loads.size()));
}

void ReplayedPartner::accept(const Window& window) {
  if (window.steps.empty()) {
    add_step(window.end, window.of(Quantity::motion));
  } else {
    for (const WindowStep& step : window.steps) add_step(step.end, step.motion);
  }
  const Window& recorded = record_.windows[next_].accepted;
  if (recorded.end - reached_ > same_time * recorded.length()) return;  // a part of it
  moved_.clear();
  ++next_;
}

void ReplayedPartner::add_step(double end, const std::vector<double>& motion) {
  if (moved_.empty()) moved_.assign(motion.size(), 0.0);
  for (std::size_t i = 0; i < motion.size(); ++i) moved_[i] += motion[i];
  reached_ = end;
  const Window& recorded = record_.windows[next_].accepted;
  const auto ends_here = [&](double time) {
    return std::abs(time - end) <= same_time * recorded.length();
  };
  if (recorded.steps.empty()) {
    if (ends_here(recorded.end)) compare(recorded.of(Quantity::motion), moved_);
    return;
  }
  std::vector<double> then(motion.size(), 0.0);
  for (const WindowStep& step : recorded.steps) {
    for (std::size_t i = 0; i < then.size(); ++i) then[i] += step.motion[i];
    if (ends_here(step.end)) return compare(then, moved_);
  }
}

void ReplayedPartner::compare(const std::vector<double>& then, const std::vector<double>& now) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    difference = std::max(difference, std::abs(now[i] - then[i]));
    size = std::max(size, std::abs(then[i]));
  }
  if (difference <= worst_ * size) return;
  worst_ = size > 0.0 ? difference / size : std::numeric_limits<double>::infinity();
  worst_window_ = record_.windows[next_].accepted.number;
}

Books ReplayedPartner::books() const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return {unknown, unknown};
}

std::string ReplayedPartner::complaint() const {
  if (worst_ <= replay_rounding) return {};
  return fmt::format(
      "{}: with the recorded loads the structure moves differently, in window {} by {:.2g} of its "
      "motion",
      file_, worst_window_, worst_);
}

std::string ReplayedPartner::left_over() const {
  if (next_ == record_.windows.size()) return {};
  const double compared =
      next_ > 0 ? record_.windows[next_ - 1].accepted.end : record_.beginning.time;
  return fmt::format("{}: compared to {:g} s only, the record goes on to {:g} s", file_, compared,
                     record_.windows.back().accepted.end);
}

PartnerReplay replay(const Record& record, Partner& partner) {
  partner.begin(record.beginning);
  const Quantities missing = partner.wanted() & ~record.partner.wanted;
  if (missing != 0) {
    throw PartnerError(
        fmt::format("the partner wants quantities {:#x}, of which the record has no {:#x}",
                    partner.wanted(), missing));
  }
  PartnerReplay found;
  double largest_energy = 0.0;
  for (const RecordedWindow& window : record.windows) {
    for (const RecordedAttempt& then : window.attempts) {
      if (then.answer.size() == 0) continue;  // the run was ended meanwhile
      const Eigen::VectorXd now = partner.loads(then.asked);
      ++found.attempts;
      if (now == then.answer) {
        ++found.equal;
        continue;
      }
      const double size = then.answer.norm();
      const double difference = (now - then.answer).norm();
      const double share = size > 0.0 ? difference / size : std::numeric_limits<double>::infinity();
      if (share <= found.loads) continue;
      found.loads = share;
      found.window = then.asked.number;
      found.attempt = then.asked.attempt;
    }
    partner.accept(window.accepted);
    ++found.windows;
    const Books now = partner.books();
    const auto compare = [&](double a, double b) {
      if (std::isnan(a) && std::isnan(b)) return;
      largest_energy = std::max(largest_energy, std::abs(b));
      const double difference = std::abs(a - b);
      found.energy = std::isfinite(difference) ? std::max(found.energy, difference)
                                               : std::numeric_limits<double>::infinity();
    };
    compare(now.energy, window.books.energy);
    compare(now.dissipated, window.books.dissipated);
  }
  if (largest_energy > 0.0) found.energy /= largest_energy;
  return found;
}

}  // namespace culm::coupling
