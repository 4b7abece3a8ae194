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
  watch_pairs();
  const int before = known_.behind.determinant.sign, now = known_.here.determinant.sign;
  return crosses() || (before != 0 && now != 0 && before != now);
}

void PathFollowing::watch_pairs() {
  const PathPoint &behind = known_.behind, &here = known_.here;
  const bool is_new = here.sets_energy_free && !behind.sets_energy_free;
  if (!is_new || !known_.events.empty() || here.determinant.sign != behind.determinant.sign) return;
  if (settings_.at_bifurcation == AtBifurcation::stop) known_.is_ended = true;
  context().findings.warn(
      "crossing",
      fmt::format(
          "between the levels {:.6g} and {:.6g} two directions lost their stiffness, and the "
          "determinant has kept its sign: other paths cross there, none of which is "
          "followed, and this one is unstable beyond; an analysis of type 'Buckling' shows "
          "where",
          behind.level, here.level),
      here.level);
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

namespace {

// A point at a length behind the last one of a path.
struct PointBehind {
  double length = 0.0;  // [m]
  double level = 0.0, watched = 0.0;
  solver::Determinant determinant;
  PathCondition::Motion way;  // to it
};

double between(const PointBehind& near, const PointBehind& far, double length,
               double PointBehind::*value) {
  const double share = (length - near.length) / (far.length - near.length);
  return near.*value + share * (far.*value - near.*value);
}

// Near to a crossing the iteration may end on the other path. A point of this one lies hardly
// beside the chord between its neighbours.
bool leaves_path(const PointBehind& near, const PointBehind& far, const PointBehind& point) {
  const PathCondition::Motion chord = far.way - near.way;
  const double share = (point.length - near.length) / (far.length - near.length);
  const PathCondition::Motion beside = point.way - near.way - share * chord;
  return PathCondition::length(beside) > 0.5 * PathCondition::length(chord);
}

// Where the level turns, by the parabola through the point where it has gone farthest and those
// beside it.
void turn_at(PathEvent& limit, std::vector<PointBehind>& points) {
  std::sort(points.begin(), points.end(),
            [](const PointBehind& a, const PointBehind& b) { return a.length < b.length; });
  const double sense = limit.level > points.front().level ? 1.0 : -1.0;
  const auto farthest = std::max_element(points.begin() + 1, points.end() - 1,
                                         [sense](const PointBehind& a, const PointBehind& b) {
                                           return sense * a.level < sense * b.level;
                                         });
  const PointBehind &a = *(farthest - 1), &b = *farthest, &c = *(farthest + 1);
  const auto slope = [](const PointBehind& from, const PointBehind& to,
                        double PointBehind::*value) {
    return (to.*value - from.*value) / (to.length - from.length);
  };
  const auto curvature = [&](double PointBehind::*value) {
    return (slope(b, c, value) - slope(a, b, value)) / (c.length - a.length);
  };
  const auto at = [&](double x, double PointBehind::*value) {
    return a.*value + (x - a.length) * (slope(a, b, value) + (x - b.length) * curvature(value));
  };
  const double bend = curvature(&PointBehind::level);
  if (bend * sense >= 0.0) return;
  const double x = 0.5 * (a.length + b.length - slope(a, b, &PointBehind::level) / bend);
  limit.level = at(x, &PointBehind::level);
  limit.watched = at(x, &PointBehind::watched);
}

}  // namespace

void PathFollowing::locate_events() {
  const PathPoint &here = known_.here, &behind = known_.behind;
  const auto find = [this](PathEventKind kind) {
    const auto begin = known_.events.begin() + static_cast<std::ptrdiff_t>(before_.events.size());
    const auto found = std::find_if(begin, known_.events.end(),
                                    [kind](const PathEvent& event) { return event.kind == kind; });
    return found == known_.events.end() ? nullptr : &*found;
  };
  const auto look_at = [this](double length, const PointBehind& near,
                              const PointBehind& far) -> std::optional<PointBehind> {
    const std::optional<solver::Determinant> determinant = go_back(length);
    if (!determinant) return {};
    PointBehind point{length, state().time, condition_.watched_displacement(state().next),
                      *determinant, condition_.way(state())};
    if (leaves_path(near, far, point)) return {};
    return point;
  };
  const auto locate = [&](PathEvent& event, PointBehind near, PointBehind far) {
    const DeterminantZero zero = approach_zero(
        {near.length, near.determinant}, {far.length, far.determinant}, [&](double length) {
          std::optional<PointBehind> point = look_at(length, near, far);
          std::optional<solver::Determinant> determinant;
          if (!point) return determinant;
          determinant = point->determinant;
          (determinant->sign == near.determinant.sign ? near : far) = std::move(*point);
          return determinant;
        });
    const double before = zero.place - near.length, after = far.length - zero.place;
    constexpr double sure = 1e-3;  // of the step
    const bool is_sure = zero.is_found || std::min(before, after) < sure * last_length_;
    // where a limit point lies, the slopes at both ends of the step tell better
    if (!is_sure && event.kind == PathEventKind::limit_point) {
      doubt_limit(event);
      return;
    }
    event.level = between(near, far, zero.place, &PointBehind::level);
    event.watched = between(near, far, zero.place, &PointBehind::watched);
    if (event.kind == PathEventKind::bifurcation) back_ = before < after ? near.length : far.length;
    if (!is_sure) doubt(event, near.level, far.level);
  };
  PointBehind near{0.0, here.level, here.watched, here.determinant, 0.0 * condition_.last_way()};
  PointBehind far{last_length_, behind.level, behind.watched, behind.determinant,
                  -condition_.last_way()};
  PathEvent *crossing = find(PathEventKind::bifurcation), *limit = find(PathEventKind::limit_point);
  back_ = 0.0;
  if (here.determinant.sign != behind.determinant.sign) {
    if (PathEvent* event = crossing ? crossing : limit) locate(*event, near, far);
  } else if (crossing && limit) {
    // beside the limit point, on the side of the crossing, the determinant has the other sign
    std::vector<PointBehind> points;
    std::optional<PointBehind> inside;
    for (const double share : {-0.02, 0.02, -0.1, 0.1, -0.3, 0.3}) {
      const double length = last_length_ * (1.0 + share) - limit->length;
      if (length <= 0.0 || length >= last_length_) continue;
      std::optional<PointBehind> point = look_at(length, near, far);
      if (!point) continue;
      if (point->determinant.sign != here.determinant.sign) {
        locate(*crossing, share < 0.0 ? near : *point, share < 0.0 ? *point : far);
        locate(*limit, share < 0.0 ? *point : near, share < 0.0 ? far : *point);
        inside = std::move(point);
        break;
      }
      points.push_back(std::move(*point));
    }
    // if it has that nowhere, the other path crosses where the level turns
    if (!inside && points.size() > 2) {
      points.push_back(near);
      points.push_back(far);
      turn_at(*limit, points);
      crossing->level = limit->level;
      crossing->watched = limit->watched;
    } else if (!inside) {
      doubt(*crossing, near.level, far.level);
    }
  }
  system().discard(state());
}

void PathFollowing::doubt(const PathEvent& event, double one_level, double other_level) {
  context().findings.warn(
      "crossing",
      fmt::format("the {} at level {:.6g} lies anywhere between {:.6g} and {:.6g}: "
                  "equilibria between them were not found; try shorter steps",
                  name_of(event.kind), event.level, one_level, other_level),
      event.level);
}

void PathFollowing::doubt_limit(const PathEvent& event) {
  context().findings.warn(
      "limit point",
      fmt::format("the limit point at level {:.6g} is interpolated over a step in which the path "
                  "bends: no equilibria between its ends were found; try shorter steps",
                  event.level),
      event.level);
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
