/// Equilibrium with loads that are too much for one solution.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/solver/newton_solver.hpp>

namespace culm::analysis {

enum class TakeUp {
  nothing,  ///< there was nothing to take up, or no part of it: the state is as it was
  done,
  stuck,  ///< the state is in equilibrium with a part of it
};

/// Brings an accepted state into equilibrium at its level, where something acts in full that
/// nothing answers yet, as loads that follow 'Constant' do at the start: they are taken up bit by
/// bit, and the log says how far. Collective.
TakeUp take_up(Context& context, solver::NewtonSolver& newton, model::State& state);

}  // namespace culm::analysis
