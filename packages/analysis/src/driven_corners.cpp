#include <culm/analysis/driven_corners.hpp>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

namespace culm::analysis {
namespace {

constexpr int few = 5;             // corners that tell whether a function leads
constexpr double notable = 0.01;   // of the speeds on both sides, or of the largest one
constexpr double smallest = 1e-9;  // way in a step, over the length of the model
constexpr double probe = 1e-4;     // of the step

std::vector<double> jumps_of(const model::Amplitude& function) {
  std::vector<std::pair<double, double>> sizes;  // of jumps, with their times
  double largest = 0.0;
  for (const double time : function.corners()) {
    const double before = function.at(std::nextafter(time, -HUGE_VAL));
    const double after = function.at(std::nextafter(time, HUGE_VAL));
    largest = std::max({largest, std::abs(before), std::abs(after)});
    sizes.emplace_back(std::abs(after - before), time);
  }
  std::vector<double> times;
  for (const auto& [size, time] : sizes) {
    if (size > notable * largest) times.push_back(time);
  }
  return times;
}

// Its corners, those first where its slope changes most beside what it is.
std::vector<double> sharpest_first(const model::Amplitude& function) {
  const std::vector<double>& times = function.corners();
  std::vector<std::pair<double, double>> turns;  // less is sharper
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double before = i > 0 ? times[i] - times[i - 1] : 1.0;
    const double after = i + 1 < times.size() ? times[i + 1] - times[i] : 1.0;
    const double here = function.at(times[i]);
    const double left = (here - function.at(times[i] - 0.5 * before)) / before;
    const double right = (function.at(times[i] + 0.5 * after) - here) / after;
    const double size = std::abs(left) + std::abs(right);
    turns.emplace_back(size > 0.0 && std::isfinite(size) ? -std::abs(right - left) / size : 0.0,
                       times[i]);
  }
  std::ranges::sort(turns);
  std::vector<double> sorted;
  for (const auto& turn : turns) sorted.push_back(turn.second);
  return sorted;
}

std::ranges::subrange<std::vector<double>::const_iterator> between(const std::vector<double>& times,
                                                                   double after, double until) {
  return {std::ranges::upper_bound(times, after), std::ranges::upper_bound(times, until)};
}

bool is_driven(const model::Constraint& constraint) { return static_cast<bool>(constraint.drive); }

}  // namespace

DrivenCorners::DrivenCorners(const assembly::System& system) : system_(system) {
  const model::Model& model = system.model();
  drives_positions_ = std::ranges::any_of(model.equations(), is_driven);
  drives_speeds_ = std::ranges::any_of(model.constraints(),
                                       [](const auto& c) { return !c.velocity_rows.empty(); });
  if (!drives_positions_ && !drives_speeds_) return;
  // what has no function of its own
  if (drives_positions_) functions_.push_back(model::Amplitude::ramp().corners());
  for (const auto& [name, function] : model.functions()) {
    if (!function.is_function_of_time()) continue;
    functions_.push_back(sharpest_first(function));
    if (!drives_speeds_) continue;
    const std::vector<double> jumps = jumps_of(function);
    jumps_.insert(jumps_.end(), jumps.begin(), jumps.end());
  }
  std::ranges::sort(jumps_);
}

// Of the functions those that lead, so that corners of loads are looked at once only.
void DrivenCorners::choose(double step, const model::State& state) {
  for (const std::vector<double>& corners : functions_) {
    const auto leads = [&](double time) { return is_corner(time, step, state); };
    if (drives_speeds_ || std::ranges::any_of(corners | std::views::take(few), leads)) {
      corners_.insert(corners_.end(), corners.begin(), corners.end());
    }
  }
  functions_.clear();
  std::ranges::sort(corners_);
}

bool DrivenCorners::are_within(double start, double end) const {
  const double slack = same_time * (end - start);
  return !between(corners_, start + slack, end - slack).empty();
}

// A speed that is driven has a corner of no consequence where a step ends.
bool DrivenCorners::in_step(const model::State& state) {
  const double step = state.time - state.time_prev;
  if (!functions_.empty()) choose(step, state);
  const double slack = same_time * step;
  const double start = state.time_prev + slack;
  if (!between(jumps_, start, state.time + slack).empty()) return true;
  if (drives_speeds_ && are_within(state.time_prev, state.time)) return true;
  return drives_positions_ &&
         std::ranges::any_of(between(corners_, start, state.time + slack),
                             [&](double time) { return is_corner(time, step, state); });
}

// By the rows of all driven equations, which move while the nodes stay.
bool DrivenCorners::is_corner(double time, double step, const model::State& state) const {
  const model::Model& model = system_.model();
  const double beside = probe * step;
  double found = 0.0;
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    const model::Constraint& c = model.equations()[e];
    const int block = model.unknowns().constraint_block(static_cast<int>(e));
    const int owner = system_.layout().owners()[static_cast<std::size_t>(block)];
    if (!is_driven(c) || owner != system_.comm().rank()) continue;
    const Eigen::Matrix3Xd slots = model::slots_of(c, state.next);
    auto before = c.rows, at = c.rows, after = c.rows;
    c.drive(time - beside, before);
    c.drive(time, at);
    c.drive(time + beside, after);
    for (std::size_t row = 0; row < c.rows.size(); ++row) {
      const double value = model::row_value(at[row], slots);
      const double left = (value - model::row_value(before[row], slots)) / beside;
      const double right = (model::row_value(after[row], slots) - value) / beside;
      const double jump = std::abs(right - left);
      const bool counts = jump > notable * (std::abs(left) + std::abs(right)) &&
                          jump * step > smallest * model.length();
      if (counts) found = 1.0;
    }
  }
  return system_.comm().max(found) > 0.0;
}

}  // namespace culm::analysis
