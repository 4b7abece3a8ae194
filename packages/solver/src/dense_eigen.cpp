#include "eigen_methods.hpp"

#include <Eigen/Dense>

#include <limits>
#include <numeric>

namespace culm::solver {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace

InvertedPairs solve_dense(ShiftInvert& op) {
  const Eigen::Index n = op.size();
  // B = R R^T with as many columns as B has rank
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_B(op.dense(*op.pencil().B));
  const Eigen::VectorXd& d = of_B.eigenvalues();  // rising
  const double least = static_cast<double>(n) * eps * d[n - 1];
  const Eigen::Index rank = (d.array() > least).count();
  const Eigen::MatrixXd R =
      of_B.eigenvectors().rightCols(rank) * d.tail(rank).cwiseSqrt().asDiagonal();
  Eigen::MatrixXd C = op.dense(*op.pencil().A);
  C -= op.shift() * op.dense(*op.pencil().B);
  const Eigen::MatrixXd X = C.partialPivLu().solve(R);
  const Eigen::MatrixXd S = R.transpose() * X;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_S(0.5 * (S + S.transpose()));

  std::vector<Eigen::Index> order(static_cast<std::size_t>(rank));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(of_S.eigenvalues()[a]) > std::abs(of_S.eigenvalues()[b]);
  });
  const double size = rank > 0 ? of_S.eigenvalues().cwiseAbs().maxCoeff() : 0.0;
  while (!order.empty() && std::abs(of_S.eigenvalues()[order.back()]) <= 1e2 * eps * size) {
    order.pop_back();
  }
  InvertedPairs pairs;
  pairs.nu = of_S.eigenvalues()(order);
  pairs.vectors = X * of_S.eigenvectors()(Eigen::all, order) * pairs.nu.cwiseInverse().asDiagonal();
  return pairs;
}

}  // namespace culm::solver
