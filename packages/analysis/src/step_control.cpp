#include <culm/analysis/step_control.hpp>
#include <culm/model/massless.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace culm::analysis {
namespace {

// With adaptive steps a node turns by at most 2 atan(1/2), 53 degrees; see formulation 4.8.
constexpr double largest_adaptive_turn = 1.0;
const double hard_turn = 2.0 * std::tan(0.5 * StepControl::most_turn);

constexpr double safety = 0.9;
// The first steps have no estimate; this makes their error 4096 times smaller.
constexpr double start = 1.0 / 16.0;
constexpr double least_growth = 0.5;
constexpr double most_growth = 2.0;

// 1 over the length of the model for positions, 1 for directors; 0 for slots without mass.
std::vector<double> error_scales(const assembly::System& system) {
  const std::vector<bool> has_mass = model::slots_with_mass(system.model());
  std::vector<double> scales(has_mass.size(), 0.0);
  for (std::size_t slot = 0; slot < scales.size(); ++slot) {
    if (!has_mass[slot]) continue;
    scales[slot] = slot % 4 == 0 ? 1.0 / system.model().length() : 1.0;
  }
  return scales;
}

}  // namespace

StepControl::StepControl(const assembly::System& system, const StepSettings& settings,
                         double error_constant, std::vector<double> stops)
    : system_(system),
      settings_(settings),
      error_constant_(error_constant),
      stops_(std::move(stops)) {
  memory_.next = settings_.adaptive ? start * settings_.step : settings_.step;
  if (settings_.adaptive) slot_scale_ = error_scales(system);
}

double StepControl::next_stop(double time) const {
  constexpr double sliver = 1e-9;  // of 'Step': rounding of the time
  const auto stop = std::ranges::upper_bound(stops_, time + sliver * settings_.step);
  return stop == stops_.end() ? settings_.end_time : std::min(*stop, settings_.end_time);
}

double StepControl::end_of_step(double time) const {
  const double step = settings_.step;
  if (settings_.adaptive) {
    const double stop = next_stop(time);
    const double left = stop - time;
    if (memory_.next > 0.99 * left) return stop;
    return time + (memory_.next > 0.5 * left ? 0.5 * left : memory_.next);  // no sliver at the end
  }
  // the next multiple of the step
  double target = step * (std::floor(time / step + 1e-6) + 1.0);
  if (target > settings_.end_time - 1e-6 * step) target = settings_.end_time;
  return time + 1.01 * memory_.next > target ? target : time + memory_.next;
}

model::NodeSlots StepControl::mean_velocity(const model::State& state, double h, int node) const {
  return (model::NodeTable::slots(state.next, node) - model::NodeTable::slots(state.prev, node)) /
         h;
}

model::NodeSlots StepControl::mean_acceleration(const model::NodeSlots& velocity, double h,
                                                int node) const {
  return (velocity - model::NodeTable::slots(memory_.velocity, node)) / (0.5 * (h + memory_.last));
}

// The third derivative from the last four configurations, by divided differences.
double StepControl::estimate_error(const model::State& state, double h) const {
  double largest = 0.0;
  for (int node : system_.owned_nodes()) {
    const model::NodeSlots change = mean_acceleration(mean_velocity(state, h, node), h, node) -
                                    model::NodeTable::slots(memory_.acceleration, node);
    for (int s = 0; s < 4; ++s) {
      largest = std::max(largest, slot_scale_[index(4 * node + s)] * change.col(s).norm());
    }
  }
  const double third = 3.0 * system_.comm().max(largest) / (h + memory_.last + memory_.before_last);
  return error_constant_ * h * h * h * third;
}

void StepControl::remember(const model::State& state, double h) {
  memory_.velocity.resize(state.next.size());
  memory_.acceleration.resize(state.next.size());
  for (int node : system_.owned_nodes()) {
    const model::NodeSlots velocity = mean_velocity(state, h, node);
    if (memory_.last > 0.0) {
      model::NodeTable::slots(memory_.acceleration, node) = mean_acceleration(velocity, h, node);
    }
    model::NodeTable::slots(memory_.velocity, node) = velocity;
  }
}

// cos(angle) = (sum_i d_i,prev . d_i,next - 1) / 2 of a triad, d_prev . d_next of a shell director,
// which may change its length; tan(angle / 2)^2 = (1 - cos) / (1 + cos)
double StepControl::largest_turn(const model::State& state) const {
  double cosine = 1.0;
  for (int node : system_.owned_nodes()) {
    const auto prev = model::NodeTable::slots(state.prev, node);
    const auto next = model::NodeTable::slots(state.next, node);
    const bool is_triad = system_.model().nodes().kind(node) == NodeKind::node12;
    const double found =
        is_triad ? 0.5 * (prev.rightCols<3>().cwiseProduct(next.rightCols<3>()).sum() - 1.0)
                 : prev.col(1).dot(next.col(1)) /
                       std::sqrt(prev.col(1).squaredNorm() * next.col(1).squaredNorm());
    cosine = std::min(cosine, found);
  }
  cosine = -system_.comm().max(-cosine);
  return 2.0 * std::sqrt(std::max(0.0, 1.0 - cosine) / std::max(1e-300, 1.0 + cosine));
}

double StepControl::growth() const {
  double growth = error_.has_value() ? most_growth : 1.0;
  if (turn_ > 0.0) growth = std::min(growth, safety * largest_adaptive_turn / turn_);
  if (error_.value_or(0.0) > 0.0) {
    growth = std::min(growth, safety * std::cbrt(settings_.adaptive->tolerance / *error_));
  }
  return std::max(growth, least_growth);
}

solver::StepEnd StepControl::judge(const model::State& state, const Stencil& stencil) {
  turn_ = largest_turn(state);
  const double allowed = settings_.adaptive ? largest_adaptive_turn : hard_turn;
  if (turn_ > allowed) return solver::StepEnd::turned_too_far;
  if (!settings_.adaptive) return solver::StepEnd::converged;
  error_.reset();
  if (memory_.before_last > 0.0) error_ = estimate_error(state, stencil.step);
  // an error that asks for less than half of the step is not worth keeping
  const bool keep = growth() > least_growth || stencil.step < 1.001 * settings_.smallest_step;
  return keep ? solver::StepEnd::converged : solver::StepEnd::inaccurate;
}

void StepControl::accept(const model::State& state, double taken) {
  if (settings_.adaptive) {
    // right after a failure the step stays
    memory_.next = taken * std::min(growth(), memory_.failed ? 1.0 : most_growth);
    memory_.next =
        std::clamp(memory_.next, settings_.smallest_step, settings_.adaptive->largest_step);
    remember(state, taken);
  } else {
    memory_.next = std::min(2.0 * memory_.next, settings_.step);
  }
  memory_.before_last = memory_.last;
  memory_.last = taken;
  memory_.failed = false;
}

void StepControl::reject(solver::StepEnd reason, double taken) {
  memory_.failed = true;
  memory_.next = least_growth * taken;
  // an error is no reason to give up
  if (reason == solver::StepEnd::inaccurate) {
    memory_.next = std::max(memory_.next, settings_.smallest_step);
  }
}

void StepControl::save(Snapshot& snapshot) const {
  snapshot.set("steps/lengths", {memory_.next, memory_.last, memory_.before_last});
  snapshot.set("steps/failed", memory_.failed ? 1.0 : 0.0);
  system_.save(memory_.velocity, "steps/velocity", snapshot);
  system_.save(memory_.acceleration, "steps/acceleration", snapshot);
}

void StepControl::restore(const Snapshot& snapshot) {
  const std::span<const double> lengths = snapshot.numbers("steps/lengths", 3);
  memory_.next = lengths[0];
  memory_.last = lengths[1];
  memory_.before_last = lengths[2];
  memory_.failed = snapshot.number("steps/failed") != 0.0;
  system_.restore(snapshot, "steps/velocity", memory_.velocity);
  system_.restore(snapshot, "steps/acceleration", memory_.acceleration);
  // steps that become adaptive now do not know the ones before
  if (settings_.adaptive && memory_.velocity.empty()) memory_.last = memory_.before_last = 0.0;
}

}  // namespace culm::analysis
