/// Distributed matrices as entries, and whole on every rank.
#pragma once

#include <culm/analysis/multi_blade.hpp>
#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>

#include <vector>

namespace culm::analysis {

/// Entries by global row and column.
struct Entries {
  std::vector<int> row, column;
  std::vector<double> value;
};

/// Those of this rank that are not zero.
Entries entries_of(const assembly::CrsMatrix& matrix);

/// The matrix on every rank. Collective.
SparseMatrix whole(const assembly::CrsMatrix& matrix, const parallel::Comm& comm);

/// The rows of a map of a matrix that is whole on every rank. Collective.
Teuchos::RCP<const assembly::CrsMatrix> distribute(const SparseMatrix& matrix,
                                                   const Teuchos::RCP<const assembly::Map>& rows);

}  // namespace culm::analysis
