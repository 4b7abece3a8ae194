#include "multiple_values.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace culm::solver {
namespace {

bool are_same(const EigenPairs& pairs, std::size_t one, std::size_t other) {
  const double a = pairs.values[one];
  const double b = pairs.values[other];
  const double by_rounding = 4.0 * (pairs.rounding[one] + pairs.rounding[other]);
  return std::abs(b - a) <= std::max(by_rounding, 1e-10 * std::max(std::abs(a), std::abs(b)));
}

// Rows within this share of the largest one are as large.
constexpr double tie = 1.0 - 1e-6;

void align(Eigen::Ref<Eigen::MatrixXd> basis) {
  for (Eigen::Index first = 0; first + 1 < basis.cols(); ++first) {
    const Eigen::Index rest = basis.cols() - first;
    const Eigen::VectorXd size = basis.rightCols(rest).rowwise().norm();
    const double enough = tie * size.maxCoeff();
    Eigen::Index row = 0;
    while (size[row] < enough) ++row;
    // an orthogonal matrix with the direction of that row as its first column
    const Eigen::VectorXd direction = basis.row(row).tail(rest).transpose();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(direction);
    const Eigen::MatrixXd turn = qr.householderQ() * Eigen::MatrixXd::Identity(rest, rest);
    basis.rightCols(rest) *= turn;
  }
}

}  // namespace

void align_multiple(EigenPairs& pairs) {
  std::size_t first = 0;
  while (first < pairs.values.size()) {
    std::size_t end = first + 1;
    while (end < pairs.values.size() && are_same(pairs, first, end)) ++end;
    align(pairs.vectors.middleCols(static_cast<Eigen::Index>(first),
                                   static_cast<Eigen::Index>(end - first)));
    first = end;
  }
}

}  // namespace culm::solver
