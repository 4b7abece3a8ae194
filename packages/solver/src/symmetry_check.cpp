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
      product_(matrix_->getRowMap()->getNodeNumElements()),
      size_(product_.size()),
      shares_(matrix_->getColMap()),
      transposed_(matrix_->getRowMap()) {
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
  multiply();
  transposed_.putScalar(0.0);
  const auto importer = matrix_->getGraph()->getImporter();
  if (importer.is_null()) {
    transposed_.assign(shares_);
  } else {
    transposed_.doExport(shares_, *importer, Tpetra::ADD);
  }
  double worst = 0.0;
  const auto transposed = values_of(std::as_const(transposed_));
  for (std::size_t row = 0; row < size_.size(); ++row) {
    const double difference = std::abs(product_[row] - transposed[row]);
    if (difference == 0.0) continue;
    worst = std::max(worst, size_[row] > 0.0 ? difference / size_[row]
                                             : std::numeric_limits<double>::infinity());
  }
  return worst;
}

// The diagonal is left out.
void SymmetryCheck::multiply() {
  const auto local = matrix_->getLocalMatrixHost();
  shares_.putScalar(0.0);
  const auto shares = values_of(shares_);
  for (std::size_t row = 0; row < size_.size(); ++row) {
    const double weight = weights_[static_cast<std::size_t>(diagonal_[row])];
    product_[row] = size_[row] = 0.0;
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      const int column = local.graph.entries(k);
      if (column == diagonal_[row]) continue;
      const double term = local.values(k) * weights_[static_cast<std::size_t>(column)];
      product_[row] += term;
      size_[row] += std::abs(term);
      shares[static_cast<std::size_t>(column)] += local.values(k) * weight;
    }
  }
}

}  // namespace culm::solver
