#include "matrix_checks.hpp"

#include <algorithm>
#include <cmath>

namespace culm::solver {

using assembly::CrsMatrix;
using assembly::Vector;

Residual residual(const CrsMatrix& A, std::span<const double> x, std::span<const double> b,
                  std::span<double> r) {
  const auto matrix = A.getLocalMatrixHost();
  Residual result;
  for (std::size_t row = 0; row < b.size(); ++row) {
    double rest = b[row];
    double terms = std::abs(b[row]);
    for (auto k = matrix.graph.row_map(row); k < matrix.graph.row_map(row + 1); ++k) {
      const double term = matrix.values(k) * x[static_cast<std::size_t>(matrix.graph.entries(k))];
      rest -= term;
      terms += std::abs(term);
    }
    if (!std::isfinite(rest)) return {HUGE_VAL, 1.0};
    if (!r.empty()) r[row] = rest;
    result.largest = std::max(result.largest, std::abs(rest));
    result.size = std::max(result.size, terms);
  }
  return result;
}

double largest_entry(const CrsMatrix& A) {
  const auto values = A.getLocalMatrixHost().values;
  double largest = 0.0;
  for (std::size_t k = 0; k < values.extent(0); ++k) {
    const double size = std::abs(values(k));
    if (!std::isfinite(size)) return HUGE_VAL;
    largest = std::max(largest, size);
  }
  return largest;
}

Teuchos::RCP<CrsMatrix> shifted_copy(const CrsMatrix& A, double shift) {
  const auto copy = Teuchos::rcp(new CrsMatrix(A, Teuchos::Copy));
  const auto matrix = copy->getLocalMatrixHost();
  for (int row = 0; row < matrix.numRows(); ++row) {
    const int diagonal = A.getColMap()->getLocalElement(A.getRowMap()->getGlobalElement(row));
    const auto at = static_cast<std::size_t>(row);
    for (auto k = matrix.graph.row_map(at); k < matrix.graph.row_map(at + 1); ++k) {
      if (matrix.graph.entries(k) == diagonal) matrix.values(k) += shift;
    }
  }
  return copy;
}

double inverse_iteration(const CrsMatrix& A, const Solve& solve, Vector& v) {
  Vector b(v.rows());
  const auto start = b.values();
  const auto rows = static_cast<long long>(b.rows().total());
  double seed = 0.5;
  for (long long row = 0; row < rows; ++row) {
    seed = std::fmod(997.0 * seed + 0.1234567, 1.0);
    if (const auto here = b.rows().local(row)) start[*here] = seed - 0.5;
  }
  for (int i = 0; i < 4; ++i) {
    solve(b, v);
    v.scale(1.0 / std::max(v.largest(), 1e-300));
    b = v;
  }
  A.apply(tpetra(v), tpetra(b));
  return b.largest();
}

}  // namespace culm::solver
