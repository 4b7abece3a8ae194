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

/// Where the nodes of this rank are, and the normals of those of shells; zero elsewhere.
struct Surface {
  std::vector<Vec3> places, normals;
};

/// Each aggregate moves as a rigid body, and one of shell nodes bends with constant curvature too,
/// in an orthonormal basis of these motions; a node that is carried keeps its unknowns. Collective.
/// @param surface  empty where none is known, or wanted
Prolongation join(const GridLevel& grid, const Aggregates& aggregates,
                  const std::vector<bool>& carried, const Surface& surface,
                  const parallel::Comm& comm);

/// One step of damped Jacobi's method with the blocks of nodes, which takes most energy out of the
/// bases: (1 - 4/(3 lambda) D^-1 A) P. Collective. @source as aggregate
NodeBlocks smooth(const NodeBlocks& rows, const GridLevel& grid, const BlockSmoother& smoother,
                  const parallel::Comm& comm);

}  // namespace culm::solver
