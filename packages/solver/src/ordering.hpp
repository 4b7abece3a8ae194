/// In which order a matrix is factored.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/solver/fill.hpp>

#include "block_rows.hpp"

#include <vector>

namespace culm::solver {

/// Nested dissection of blocks of rows with one pattern: the unknowns of a node.
struct Ordering {
  std::vector<int> place;  ///< of each global row among the pivots; on the root only
  Fill fill;               ///< what follows from it; on all ranks
};

/// Collective. Only one row of each block travels to the root.
Ordering order_rows(const assembly::CrsMatrix& matrix, const parallel::Comm& comm);
/// Of a matrix on this rank alone. @param kept  rows at the end that are not eliminated; they come
/// last, and only the others fill
Ordering order_rows(const BlockRows& rows, int kept);

}  // namespace culm::solver
