#include <culm/analysis/missed_pulses.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace culm::analysis {
namespace {

// A pulse counts if it is a tenth of the largest value, and comes back by half of its height.
constexpr double notable_height = 0.1;
constexpr double end_difference = 0.5;
// Of functions without corners, half of the largest value: more than an arc of a sine over a third
// of its period, which deviates from its chord by 0.43.
constexpr double notable_arc = 0.5;
// Points within a step, at uneven places: they do not meet the zeros of what is periodic in it.
constexpr std::array<double, 9> points = {0.07, 0.19, 0.28, 0.41, 0.52, 0.63, 0.74, 0.85, 0.96};

// On both sides of a time: functions may jump there.
std::pair<double, double> values_beside(const model::Amplitude& function, double time) {
  return {function.at(std::nextafter(time, -HUGE_VAL)),
          function.at(std::nextafter(time, HUGE_VAL))};
}

double largest_corner(const model::Amplitude& function) {
  double size = 0.0;
  for (double time : function.corners()) {
    const auto [before, after] = values_beside(function, time);
    size = std::max({size, std::abs(before), std::abs(after)});
  }
  return size;
}

// What the function does between the ends of a step beyond a straight line between them; `at_start`
// is its value there.
bool is_missed(const model::Amplitude& function, double size, double at_start, double start,
               double end) {
  const std::vector<double>& corners = function.corners();
  const auto first = std::ranges::lower_bound(corners, start);
  const auto last = std::ranges::lower_bound(corners, end);
  if (last - first < 2) return false;
  const double at_end = function.at(end);
  double height = 0.0;
  for (auto corner = first; corner != last; ++corner) {
    const double share = (*corner - start) / (end - start);
    const double line = (1.0 - share) * at_start + share * at_end;
    const auto [before, after] = values_beside(function, *corner);
    if (corner != first) height = std::max(height, std::abs(before - line));
    height = std::max(height, std::abs(after - line));
  }
  return height > notable_height * size && std::abs(at_end - at_start) < end_difference * height;
}

// The same of a function without corners, which goes beyond both of its values at the ends: one
// that falls or jumps within the step does not. `size` grows with what is seen.
bool is_unresolved(const model::Amplitude& function, double& size, double start, double end) {
  const double at_start = function.at(start);
  const double at_end = function.at(end);
  const auto [low, high] = std::minmax(at_start, at_end);
  double height = 0.0;
  double beyond = 0.0;
  size = std::max({size, std::abs(at_start), std::abs(at_end)});
  for (const double share : points) {
    const double value = function.at((1.0 - share) * start + share * end);
    size = std::max(size, std::abs(value));
    height = std::max(height, std::abs(value - (1.0 - share) * at_start - share * at_end));
    beyond = std::max({beyond, value - high, low - value});
  }
  return height > notable_arc * size && beyond > notable_height * size;
}

}  // namespace

MissedPulses::MissedPulses(const std::map<std::string, model::Amplitude>& functions) {
  for (const auto& [name, function] : functions) {
    const bool is_smooth = function.corners().empty();
    if (is_smooth ? !function.is_function_of_time() || function.is_constant()
                  : function.corners().size() < 2) {
      continue;
    }
    candidates_.push_back({name, function, largest_corner(function), false});
  }
}

void MissedPulses::check(double start, double end, Findings& findings) {
  for (Candidate& candidate : candidates_) {
    if (candidate.is_told) continue;
    const model::Amplitude& function = candidate.function;
    const auto tell = [&](const char* what, const char* fate) {
      candidate.is_told = true;
      findings.warn(
          "missed pulse",
          fmt::format("function '{}' {} within the time step from {:.6g} s to {:.6g} s: {}",
                      candidate.name, what, start, end, fate),
          end);
    };
    if (function.corners().empty()) {
      if (is_unresolved(function, candidate.size, start, end)) {
        tell("goes up and down",
             "what it does there is lost or taken for something slower; take shorter steps");
      }
      continue;
    }
    // what begins with the motion, as a square does, has not acted before
    const bool begins = is_first_ && start == function.corners().front();
    const double at_start = begins ? 0.0 : function.at(std::nextafter(start, -HUGE_VAL));
    if (is_missed(function, candidate.size, at_start, start, end)) {
      tell("has a pulse that begins and ends",
           "it acts in part or not at all; take steps that are shorter than the pulse");
    }
  }
  is_first_ = false;
}

void MissedPulses::save(Snapshot& snapshot) const {
  std::vector<double> told;
  for (const Candidate& candidate : candidates_) told.push_back(candidate.is_told ? 1.0 : 0.0);
  snapshot.set("pulses/told", std::move(told));
  snapshot.set("pulses/first", is_first_ ? 1.0 : 0.0);
}

void MissedPulses::restore(const Snapshot& snapshot) {
  const std::span<const double> told = snapshot.numbers("pulses/told", candidates_.size());
  for (std::size_t i = 0; i < told.size(); ++i) candidates_[i].is_told = told[i] != 0.0;
  is_first_ = snapshot.number("pulses/first") != 0.0;
}

}  // namespace culm::analysis
