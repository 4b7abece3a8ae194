/// Rows of a matrix that belong together, found in its graph.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/partition.hpp>

#include "block_rows.hpp"

#include <vector>

namespace culm::solver {

/// Rows that stand together and have the same columns, and those columns.
struct Blocks {
  std::vector<long long> rows;     ///< block after block
  std::vector<int> sizes;          ///< rows of each block
  std::vector<long long> columns;  ///< block after block
  std::vector<int> widths;         ///< columns of each block
};

/// Those of rows whose sources follow each other, too, by their local numbers; columns rise within
/// a block.
Blocks find_blocks(const BlockRows& rows);
/// Those of this rank's rows, by their global numbers.
Blocks find_blocks(const assembly::CrsMatrix& matrix);

/// Block of each row, by its global number. @param blocks of all rows
std::vector<int> block_of_row(const Blocks& blocks);

/// The graph of the blocks, with an edge where either has an entry in the columns of the other, and
/// their sizes as weights.
parallel::Graph couple(const Blocks& blocks, const std::vector<int>& block_of);

}  // namespace culm::solver
