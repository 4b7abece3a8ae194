#include <culm/analysis/missed_pulses.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

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

// Of an impulse; four steps per period of a sine take 0.11 too much of half a period.
constexpr double notable_loss = 0.25;
// Of the largest value over a step: less is the foot of what only begins to rise.
constexpr double notable_impulse = 0.01;
// Of adaptive steps: a change between samples that is none of a function which steps follow, and
// what may be lost of an impulse there, over a usual step.
constexpr double notable_leap = 0.3;
constexpr double loss_at_jump = 0.01;
// Of statics, where the way counts: sixteen steps per period of a sine pass over less of its turns.
constexpr double notable_turn = 0.02;

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

// Values of a function without corners, at the ends of a step and at `points` in it.
using Samples = std::array<double, points.size() + 2>;

Samples sample(const model::Amplitude& function, double start, double end) {
  Samples values;
  values.front() = function.at(start);
  values.back() = function.at(end);
  for (std::size_t i = 0; i < points.size(); ++i) {
    values[i + 1] = function.at((1.0 - points[i]) * start + points[i] * end);
  }
  return values;
}

// The same of a function without corners, which goes beyond both of its values at the ends: one
// that falls or jumps within the step does not. `size` grows with what is seen.
bool is_unresolved(const Samples& values, double& size) {
  const auto [low, high] = std::minmax(values.front(), values.back());
  double height = 0.0;
  double beyond = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = values[i + 1];
    const double line = (1.0 - points[i]) * values.front() + points[i] * values.back();
    height = std::max(height, std::abs(value - line));
    beyond = std::max({beyond, value - high, low - value});
  }
  return height > notable_arc * size && beyond > notable_height * size;
}

// How far a function goes beyond both of its values at the ends of a step; `size` grows with what
// is seen.
double beyond_ends(const model::Amplitude& function, double start, double end, double& size) {
  const double first = function.at(start);
  const double last = function.at(end);
  double low = std::min(first, last);
  double high = std::max(first, last);
  const double lowest = low;
  const double highest = high;
  const auto see = [&](double value) {
    low = std::min(low, value);
    high = std::max(high, value);
    size = std::max(size, std::abs(value));
  };
  if (function.corners().empty()) {
    std::ranges::for_each(sample(function, start, end), see);
  } else {
    const std::vector<double>& corners = function.corners();
    auto corner = std::ranges::upper_bound(corners, start);
    for (; corner != corners.end() && *corner < end; ++corner) {
      const auto [before, after] = values_beside(function, *corner);
      see(before);
      see(after);
    }
  }
  return std::max(high - highest, lowest - low);
}

// By straight lines between samples.
MissedPulses::Impulse impulse_of(const Samples& values, const model::Amplitude& function,
                                 double start, double end) {
  MissedPulses::Impulse impulse;
  double before = 0.0;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    const double share = i < points.size() ? points[i] : 1.0;
    const double half = 0.5 * (share - before) * (end - start);
    impulse.given += half * (values[i] + values[i + 1]);
    impulse.size += half * (std::abs(values[i]) + std::abs(values[i + 1]));
    before = share;
  }
  impulse.taken = (end - start) * function.at(0.5 * (start + end));
  return impulse;
}

// By cubic pieces between corners.
MissedPulses::Impulse impulse_of(const model::Amplitude& function, double start, double end) {
  MissedPulses::Impulse impulse;
  double from = start;
  const auto add_until = [&](double to) {
    const double first = values_beside(function, from).second;
    const double middle = function.at(0.5 * (from + to));
    const double last = values_beside(function, to).first;
    impulse.given += (to - from) / 6.0 * (first + 4.0 * middle + last);
    impulse.size += (to - from) / 6.0 * (std::abs(first) + 4.0 * std::abs(middle) + std::abs(last));
    from = to;
  };
  const std::vector<double>& corners = function.corners();
  auto corner = std::ranges::upper_bound(corners, start);
  for (; corner != corners.end() && *corner < end; ++corner) add_until(*corner);
  add_until(end);
  impulse.taken = (end - start) * function.at(0.5 * (start + end));
  return impulse;
}

}  // namespace

MissedPulses::Impulse& MissedPulses::Impulse::operator+=(const Impulse& other) {
  given += other.given;
  taken += other.taken;
  size += other.size;
  return *this;
}

MissedPulses::MissedPulses(const model::Model& model) {
  const auto add = [&](const std::string& name, const model::Amplitude& function) {
    const bool is_smooth = function.corners().empty();
    if (is_smooth ? !function.is_function_of_time() || function.is_constant()
                  : function.corners().size() < 2) {
      return;
    }
    candidates_.push_back({name, function, largest_corner(function), {}, false});
  };
  for (const auto& [name, function] : model.functions()) {
    add(fmt::format("function '{}'", name), function);
  }
  for (const auto& [name, variation] : model.variations()) add(name, variation);
}

void MissedPulses::check_turns(double start, double end, Findings& findings) {
  for (Candidate& candidate : candidates_) {
    if (candidate.is_told) continue;
    const double beyond = beyond_ends(candidate.function, start, end, candidate.size);
    if (beyond <= notable_turn * candidate.size) continue;
    candidate.is_told = true;
    findings.warn("missed turn",
                  fmt::format("{} turns between the levels {:.6g} and {:.6g} of a step, {:.2g} of "
                              "its largest value beyond what it is there: friction, plastic flow "
                              "and soil that remembers do not see it; put the turn among 'Levels', "
                              "or take more 'Steps'",
                              candidate.name, start, end, beyond / candidate.size),
                  end);
  }
}

bool MissedPulses::are_lost(double start, double end, double usual) const {
  return std::ranges::any_of(candidates_, [&](const Candidate& candidate) {
    if (!candidate.function.corners().empty()) return false;
    const Samples values = sample(candidate.function, start, end);
    double size = candidate.size;
    double leap = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      size = std::max(size, std::abs(values[i]));
      if (i > 0) leap = std::max(leap, std::abs(values[i] - values[i - 1]));
    }
    const bool jumps = leap > notable_leap * size;
    if (!jumps && end - start <= usual) return false;
    return impulse_of(values, candidate.function, start, end).lost() >
           (jumps ? loss_at_jump : notable_height) * size * usual;
  });
}

void MissedPulses::check(double start, double end, Findings& findings) {
  for (Candidate& candidate : candidates_) {
    if (candidate.is_told) continue;
    const model::Amplitude& function = candidate.function;
    const auto tell = [&](std::string_view what, std::string_view fate) {
      candidate.is_told = true;
      findings.warn("missed pulse",
                    fmt::format("{} {} within the time step from {:.6g} s to {:.6g} s: {}",
                                candidate.name, what, start, end, fate),
                    end);
    };
    if (function.corners().empty()) {
      const Samples values = sample(function, start, end);
      candidate.impulse += impulse_of(values, function, start, end);
      if (is_unresolved(values, candidate.size)) {
        tell("goes up and down",
             "what it does there is lost or taken for something slower; take shorter steps");
      }
    } else {
      candidate.impulse += impulse_of(function, start, end);
      // what begins with the motion, as a square does, has not acted before
      const bool begins = is_first_ && start == function.corners().front();
      const double at_start = begins ? 0.0 : function.at(std::nextafter(start, -HUGE_VAL));
      if (is_missed(function, candidate.size, at_start, start, end)) {
        tell("has a pulse that begins and ends",
             "loads take its value at the middle of the step for the whole of it, so that it acts "
             "too much, in part or not at all; take steps that are shorter than the pulse");
      }
    }
    const double size = candidate.impulse.size;
    if (candidate.is_told || candidate.impulse.lost() <= notable_loss * size ||
        size <= notable_impulse * candidate.size * (end - start)) {
      continue;
    }
    // as long as it acts, what comes may make up for what was lost
    if (std::abs(values_beside(function, end).second) <= notable_height * candidate.size) {
      tell("has a pulse that ends",
           fmt::format(
               "its impulse so far is {:.4g} s, of which loads take {:.4g} s, by its values at the "
               "middles of steps; a prescribed position goes straight from its value at one end of "
               "a step to that at the other, and a prescribed angular velocity takes all of it; "
               "take "
               "steps that are much shorter than the pulse",
               candidate.impulse.given, candidate.impulse.taken));
    }
  }
  is_first_ = false;
}

void MissedPulses::save(Snapshot& snapshot) const {
  std::vector<double> told;
  for (const Candidate& candidate : candidates_) told.push_back(candidate.is_told ? 1.0 : 0.0);
  snapshot.set("pulses/told", std::move(told));
  std::vector<double> impulses;
  for (const Candidate& candidate : candidates_) {
    const Impulse& impulse = candidate.impulse;
    impulses.insert(impulses.end(), {impulse.given, impulse.taken, impulse.size});
  }
  snapshot.set("pulses/impulses", std::move(impulses));
  snapshot.set("pulses/first", is_first_ ? 1.0 : 0.0);
}

void MissedPulses::restore(const Snapshot& snapshot) {
  const std::span<const double> told = snapshot.numbers("pulses/told", candidates_.size());
  for (std::size_t i = 0; i < told.size(); ++i) candidates_[i].is_told = told[i] != 0.0;
  const std::span<const double> impulses =
      snapshot.numbers("pulses/impulses", 3 * candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    candidates_[i].impulse = {impulses[3 * i], impulses[3 * i + 1], impulses[3 * i + 2]};
  }
  is_first_ = snapshot.number("pulses/first") != 0.0;
}

}  // namespace culm::analysis
