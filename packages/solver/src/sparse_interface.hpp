/// What substructures leave between them, as a sparse matrix.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include "substructures.hpp"

#include <cstddef>
#include <vector>

namespace culm::solver {

/// S of `Substructures`, on the root. The pattern is made once.
class SparseInterface {
 public:
  explicit SparseInterface(const Substructures& parts);
  const assembly::CrsMatrix& matrix() const { return *matrix_; }
  /// Takes what was gathered last.
  void fill(const Substructures& parts);

 private:
  Teuchos::RCP<assembly::CrsMatrix> matrix_;
  std::vector<std::size_t> place_;  ///< of each gathered number
};

}  // namespace culm::solver
