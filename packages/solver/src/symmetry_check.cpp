#include "symmetry_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace culm::solver {

using assembly::CrsMatrix;
using assembly::GlobalIndex;
using assembly::values_of;

namespace {

// Between 0.5 and 1.5, with no pattern that a matrix might share.
double weight_of(GlobalIndex column) {
  const auto mixed = static_cast<std::uint64_t>(column + 1) * 0x9e3779b97f4a7c15ULL;
  return 0.5 + std::ldexp(static_cast<double>(mixed >> 11), -53);
}

}  // namespace

SymmetryCheck::SymmetryCheck(Teuchos::RCP<const CrsMatrix> matrix)
    : matrix_(std::move(matrix)),
      size_(matrix_->getRowMap()->getNodeNumElements()),
      difference_(matrix_->getRowMap()),
      transposed_(matrix_->getColMap()) {
  const auto& columns = *matrix_->getColMap();
  for (std::size_t column = 0; column < columns.getNodeNumElements(); ++column) {
    weights_.push_back(weight_of(columns.getGlobalElement(static_cast<int>(column))));
  }
  for (std::size_t row = 0; row < size_.size(); ++row) {
    const GlobalIndex number = matrix_->getRowMap()->getGlobalElement(static_cast<int>(row));
    diagonal_.push_back(columns.getLocalElement(number));
  }
}

double SymmetryCheck::asymmetry() {
  const auto local = matrix_->getLocalMatrixHost();
  difference_.putScalar(0.0);
  transposed_.putScalar(0.0);
  {
    const auto difference = values_of(difference_);
    const auto transposed = values_of(transposed_);
    for (std::size_t row = 0; row < size_.size(); ++row) {
      const double weight = weights_[static_cast<std::size_t>(diagonal_[row])];
      double sum = 0.0;
      double size = 0.0;
      for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
        const int column = local.graph.entries(k);
        if (column == diagonal_[row]) continue;
        const double term = local.values(k) * weights_[static_cast<std::size_t>(column)];
        sum += term;
        size += std::abs(term);
        transposed[static_cast<std::size_t>(column)] -= local.values(k) * weight;
      }
      difference[row] = sum;
      size_[row] = size;
    }
  }
  const auto importer = matrix_->getGraph()->getImporter();
  if (importer.is_null()) {
    difference_.update(1.0, transposed_, 1.0);
  } else {
    difference_.doExport(transposed_, *importer, Tpetra::ADD);
  }
  double worst = 0.0;
  const auto difference = values_of(std::as_const(difference_));
  for (std::size_t row = 0; row < size_.size(); ++row) {
    if (difference[row] == 0.0) continue;
    worst = std::max(worst, size_[row] > 0.0 ? std::abs(difference[row]) / size_[row]
                                             : std::numeric_limits<double>::infinity());
  }
  return worst;
}

}  // namespace culm::solver
