// What a path does where it turns or crosses another one: it finds the place, tells of it, and goes
// on to the crossing path where that was asked for.
#include <culm/analysis/path_following.hpp>

#include "determinant_zero.hpp"
#include "mirrored_faces.hpp"
#include "turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {

using assembly::Vector;

bool PathFollowing::examine(const PathTangent& tangent, const solver::Determinant& determinant) {
  known_.here.tangent = tangent;
  known_.here.determinant = determinant;
  known_.is_examined = true;
  if (!known_.has_behind) return false;
  for (const PathEvent& event : find_events(known_.behind, known_.here, last_length_)) {
    known_.events.push_back(event);
  }
  if (crosses() && settings_.at_bifurcation == AtBifurcation::stop) known_.is_ended = true;
  if (passed_limit_points()) known_.is_ended = true;
  const int before = known_.behind.determinant.sign, now = known_.here.determinant.sign;
  return crosses() || (before != 0 && now != 0 && before != now);
}

bool PathFollowing::crosses() const {
  return std::any_of(known_.events.begin() + static_cast<std::ptrdiff_t>(before_.events.size()),
                     known_.events.end(), [](const PathEvent& event) {
                       return event.kind == PathEventKind::bifurcation;
                     });
}

bool PathFollowing::is_to_branch() const {
  return crosses() && settings_.at_bifurcation == AtBifurcation::follow && !known_.has_branched &&
         !known_.is_ended;
}

std::optional<solver::Determinant> PathFollowing::go_back(double length) {
  const Stencil stencil = Stencil::statics();
  condition_.begin_back(length);
  system().prepare(state(), stencil);
  const solver::StepOutcome outcome = newton().solve(state(), stencil, &condition_);
  if (!outcome.converged() || -condition_.straightness(state()) < least_straightness) return {};
  system().evaluate(state(), stencil, Want::residual_and_tangent);
  if (!context().linear.factor()) return {};
  return context().linear.determinant();
}

void PathFollowing::locate_zero() {
  const auto kind = crosses() ? PathEventKind::bifurcation : PathEventKind::limit_point;
  const auto begin = known_.events.begin() + static_cast<std::ptrdiff_t>(before_.events.size());
  const auto found = std::find_if(begin, known_.events.end(),
                                  [kind](const PathEvent& event) { return event.kind == kind; });
  if (found == known_.events.end()) return;
  PathEvent& crossing = *found;
  const auto look_at = [&](double length) {
    const std::optional<solver::Determinant> determinant = go_back(length);
    if (determinant) {
      crossing.level = state().time;
      crossing.watched = condition_.watched_displacement(state().next);
    }
    return determinant;
  };
  back_ = approach_zero(known_.here.determinant, known_.behind.determinant, last_length_, look_at);
  system().discard(state());
}

void PathFollowing::tell_events() {
  for (std::size_t i = before_.events.size(); i < known_.events.size(); ++i) {
    context().log.info(describe(known_.events[i]));
  }
}

std::optional<solver::StepOutcome> PathFollowing::branch_off() {
  const Stencil stencil = Stencil::statics();
  model::State& state = this->state();
  known_.has_branched = true;
  const auto go_to_crossing = [&] {
    if (back_ > 0.0 && go_back(back_)) return;
    system().discard(state);
    system().prepare(state, stencil);
  };
  go_to_crossing();
  system().evaluate(state, stencil, Want::residual_and_tangent);
  Vector motion(system().layout().rows());
  context().linear.weakest_direction(motion);
  double amplitude = settings_.branch_amplitude.value_or(last_length_);
  constexpr int most_attempts = 8;
  for (int i = 0; i < most_attempts; ++i, amplitude *= 0.5) {
    if (i > 0) go_to_crossing();
    const double factor = condition_.begin_branch(state, motion, amplitude);
    system().move(state, motion, factor);
    solver::StepOutcome outcome = newton().solve(state, stencil, &condition_);
    refuse_mirrored(context(), state, outcome);
    refuse_missed_turns(context(), state, stencil, outcome);
    if (outcome.converged() && may_cross_at(state.time)) return outcome;
    system().discard(state);
  }
  context().findings.warn(
      "branch", "the crossing path was not found; a 'Branch Amplitude' may help", state.time);
  return {};
}

// The crossing lies between the last two points, and the branch begins there. Limit points between
// them hide how far the level has gone, so the slopes count, too.
bool PathFollowing::may_cross_at(double level) const {
  const PathPoint &behind = known_.behind, &here = known_.here;
  const double slope = std::max(std::abs(behind.tangent.level), std::abs(here.tangent.level));
  const double reach =
      0.5 * std::max(std::abs(here.level - behind.level), slope * std::abs(last_length_));
  const auto [low, high] = std::minmax(behind.level, here.level);
  return level >= low - reach && level <= high + reach;
}

std::string PathFollowing::describe(const PathEvent& event) const {
  std::string text = fmt::format("{} at level {:.6g}", name_of(event.kind), event.level);
  if (settings_.watch) {
    text += fmt::format(", displacement of '{}' {:.6g} m", settings_.watch->node, event.watched);
  }
  return text;
}

}  // namespace culm::analysis
