/// From a coarse grid to a fine one.
#pragma once

#include "aggregates.hpp"
#include "block_smoother.hpp"
#include "node_blocks.hpp"

namespace culm::solver {

/// Rows of the nodes of this rank, and what they leave for the coarse grid.
struct Prolongation {
  NodeBlocks rows;
  std::vector<int> widths;       ///< unknowns of each coarse node of this rank
  std::vector<long long> begin;  ///< where the coarse unknowns of each rank begin, and the end
  NearNullSpace rigid;           ///< of the coarse unknowns
};

/// Each aggregate moves as a rigid body, in an orthonormal basis of its rigid motions; a node that
/// is carried keeps its unknowns. Collective.
Prolongation join_rigidly(const GridLevel& grid, const Aggregates& aggregates,
                          const std::vector<bool>& carried, const parallel::Comm& comm);

/// One step of damped Jacobi's method with the blocks of nodes, which takes most energy out of the
/// bases: (1 - 4/(3 lambda) D^-1 A) P. Collective. @source as aggregate
NodeBlocks smooth(const NodeBlocks& rows, const GridLevel& grid, const BlockSmoother& smoother,
                  const parallel::Comm& comm);

}  // namespace culm::solver
