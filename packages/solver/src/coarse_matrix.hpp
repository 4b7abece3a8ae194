/// The matrix of a coarse grid.
#pragma once

#include "grid_level.hpp"
#include "node_blocks.hpp"

namespace culm::solver {

/// P^T A P, in rows of the coarse nodes of each rank. @param widths unknowns of these @param begin
/// where the coarse unknowns of each rank begin, and the end. Collective.
Teuchos::RCP<assembly::CrsMatrix> make_coarse_matrix(const GridLevel& grid, const NodeBlocks& rows,
                                                     const std::vector<int>& widths,
                                                     const std::vector<long long>& begin,
                                                     const parallel::Comm& comm);

/// P as rows over the local columns of that matrix.
GroupedMatrix over_columns(const NodeBlocks& rows, const assembly::Map& columns);

}  // namespace culm::solver
