/// Distributed matrices as entries, and whole on every rank.
#pragma once

#include <culm/analysis/multi_blade.hpp>
#include <culm/assembly/matrix.hpp>
#include <culm/parallel/comm.hpp>

#include <vector>

namespace culm::analysis {

/// Entries by global row and column.
struct Entries {
  std::vector<int> row, column;
  std::vector<double> value;
};

/// Those of this rank that are not zero.
Entries entries_of(const assembly::Matrix& matrix);

/// The matrix on every rank. Collective.
SparseMatrix whole(const assembly::Matrix& matrix, const parallel::Comm& comm);

}  // namespace culm::analysis
