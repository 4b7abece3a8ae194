/// Loads and motions together, where structure and partners work at the same time.
#pragma once

#include <culm/coupling/parts.hpp>
#include <culm/coupling/window.hpp>

#include "coupled_side.hpp"

#include <Eigen/Core>

#include <vector>

namespace culm::simulation {

/// With what an attempt begins on both sides, or what came of it: the loads of all sides, and how
/// the points of each move.
struct CoupledGuess {
  Eigen::VectorXd loads;
  std::vector<coupling::Window> motions;
};

/// What to try after a guess and what came of it: the loads, and each quantity that a side wants,
/// are parts of one vector.
CoupledGuess improve(coupling::Scheme& scheme, coupling::PartScale& scale,
                     const std::vector<CoupledSide>& sides, const CoupledGuess& guess,
                     const CoupledGuess& found);

}  // namespace culm::simulation
