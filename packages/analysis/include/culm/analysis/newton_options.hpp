/// Newton settings in a deck.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/solver/newton_solver.hpp>

namespace culm::analysis {

/// Parameters of the Newton iteration, for every analysis that solves nonlinear equations.
Schema newton_schema();
solver::NewtonSettings newton_settings(const Options& options);

}  // namespace culm::analysis
