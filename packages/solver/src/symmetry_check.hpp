/// Whether the values of a distributed matrix are symmetric.
#pragma once

#include <culm/assembly/tpetra.hpp>

#include <vector>

namespace culm::solver {

/// Compares A x with A^T x for one x without symmetry, because the search for mirrored entries
/// would have to cross ranks. Costs as much as two products with A. Every row has a diagonal entry.
class SymmetryCheck {
 public:
  explicit SymmetryCheck(Teuchos::RCP<const assembly::CrsMatrix> matrix);

  /// |(A - A^T) x| over |A| |x| in the worst row of this rank, for the present values: rounding if
  /// and only if they are symmetric. Collective.
  double asymmetry();

 private:
  void multiply();

  Teuchos::RCP<const assembly::CrsMatrix> matrix_;
  std::vector<int> diagonal_;          ///< local column of the diagonal entry of each row
  std::vector<double> weights_;        ///< x, of the local columns
  std::vector<double> product_;        ///< A x
  std::vector<double> size_;           ///< |A| |x|
  assembly::TpetraVector shares_;      ///< what the rows of this rank add to A^T x
  assembly::TpetraVector transposed_;  ///< A^T x
};

}  // namespace culm::solver
