#include "turns.hpp"

#include <culm/analysis/step_control.hpp>
#include <culm/math/rotation.hpp>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

bool leads_too_far(const model::Constraint& c, const model::State& state, const Stencil& stencil) {
  const bool is_static = stencil.step == 0.0;
  if (!c.turn || (is_static && !c.velocity_rows.empty())) return false;
  const double most = (is_static ? quarter_turn : StepControl::most_turn) * (1.0 + 1e-9);
  const double end = c.turn->prescribed(state, 1.0);
  if (std::abs(end - c.turn->prescribed(state, 0.0)) > most) return true;
  return c.turn->off && c.turn->off(end, model::slots_of(c, state.prev)) > most;
}

bool is_missed(const model::Constraint& c, const model::State& state) {
  return c.turn && c.turn->off &&
         c.turn->off(c.turn->prescribed(state, 1.0), model::slots_of(c, state.next)) > quarter_turn;
}

Mat3 directors(const model::Coordinates& q, int node) {
  return model::NodeTable::slots(q, node).rightCols<3>();
}

// The rotation vector of a node in a step, shorter than half a turn.
Vec3 turn_of(const model::State& state, int node) {
  const Vec3 tau = cayley_vector(directors(state.prev, node), directors(state.next, node));
  const double length = tau.norm();
  return length > 0.0 ? Vec3(2.0 * std::atan(0.5 * length) / length * tau) : Vec3(Vec3::Zero());
}

// Whether two nodes are joined whose angle may be counted, as by a torsion spring.
bool is_pair(const model::Constraint& c, const model::NodeTable& nodes) {
  return c.is_internal && !c.link && c.nodes.size() == 2 &&
         std::ranges::all_of(c.nodes,
                             [&](int node) { return nodes.kind(node) == NodeKind::node12; });
}

bool turns_apart(const model::Constraint& c, const model::State& state) {
  return (turn_of(state, c.nodes[1]) - turn_of(state, c.nodes[0])).norm() > StepControl::most_turn;
}

// Each constraint is on some rank.
bool is_here(const model::Constraint& c, const assembly::System& system) {
  return std::ranges::all_of(c.nodes, [&](int node) { return system.needs(node); });
}

// Refuses a step on all ranks that one of them refuses.
void refuse_together(const assembly::System& system, bool is_refused,
                     solver::StepOutcome& outcome) {
  if (system.comm().max(is_refused ? 1 : 0) == 0) return;
  outcome.end = solver::StepEnd::turned_too_far;
}

}  // namespace

const model::Constraint* find_too_far(const assembly::System& system, const model::State& state,
                                      const Stencil& stencil) {
  for (const model::Constraint& c : system.model().constraints()) {
    if (!c.turn) continue;
    const bool is_found = is_here(c, system) && leads_too_far(c, state, stencil);
    if (system.comm().max(is_found ? 1 : 0) != 0) return &c;
  }
  return nullptr;
}

void refuse_missed_turns(Context& context, const model::State& state, const Stencil& stencil,
                         solver::StepOutcome& outcome) {
  const assembly::System& system = context.system;
  const auto& constraints = system.model().constraints();
  const auto is_prescribed = [](const model::Constraint& c) { return c.turn.has_value(); };
  if (!outcome.converged() || std::ranges::none_of(constraints, is_prescribed)) return;
  const bool is_refused = std::ranges::any_of(constraints, [&](const model::Constraint& c) {
    return is_prescribed(c) && is_here(c, system) &&
           (leads_too_far(c, state, stencil) || is_missed(c, state));
  });
  refuse_together(system, is_refused, outcome);
}

void refuse_turns_apart(Context& context, const model::State& state, double largest_turn,
                        solver::StepOutcome& outcome) {
  if (!outcome.converged() || 2.0 * largest_turn <= StepControl::most_turn) return;
  const assembly::System& system = context.system;
  const bool is_refused =
      std::ranges::any_of(system.model().constraints(), [&](const model::Constraint& c) {
        return is_pair(c, system.model().nodes()) && is_here(c, system) && turns_apart(c, state);
      });
  refuse_together(system, is_refused, outcome);
}

}  // namespace culm::analysis
