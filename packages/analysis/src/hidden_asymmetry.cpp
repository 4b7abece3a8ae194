#include "hidden_asymmetry.hpp"

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

constexpr double asymmetry_by_rounding = 1e-12;  // of the largest entries of row and column
constexpr double noticeable_asymmetry = 1e-4;    // of lambda

Eigen::VectorXd largest_of_columns(const SparseMatrix& matrix) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(matrix.cols());
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator at(matrix, column); at; ++at) {
      largest[column] = std::max(largest[column], std::abs(at.value()));
    }
  }
  return largest;
}

SparseMatrix skew_part(const SparseMatrix& matrix) {
  const SparseMatrix transposed = matrix.transpose();
  SparseMatrix difference = matrix - transposed;
  const Eigen::VectorXd size =
      largest_of_columns(matrix).cwiseMax(largest_of_columns(transposed)).cwiseSqrt();
  difference.prune([&](Eigen::Index row, Eigen::Index column, double value) {
    return std::abs(value) > asymmetry_by_rounding * size[row] * size[column];
  });
  return difference;
}

}  // namespace

bool hides_asymmetry(const SparseMatrix& stiffness, const SparseMatrix& mass,
                     std::span<const double> squares, const Eigen::MatrixXd& modes) {
  const SparseMatrix skew = skew_part(stiffness);
  if (skew.nonZeros() == 0) return false;
  const Eigen::VectorXd masses = mass.diagonal();
  for (std::size_t i = 0; i < squares.size(); ++i) {
    if (squares[i] == 0.0) continue;
    const Eigen::VectorXd forces = skew * modes.col(static_cast<Eigen::Index>(i));
    double sum = 0.0;
    for (Eigen::Index k = 0; k < forces.size(); ++k) {
      if (masses[k] > 0.0) sum += forces[k] * forces[k] / masses[k];
    }
    if (std::sqrt(sum) > noticeable_asymmetry * std::abs(squares[i])) return true;
  }
  return false;
}

}  // namespace culm::analysis
