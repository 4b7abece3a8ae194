#include "eigen_methods.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>
#include <numeric>

namespace culm::solver {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Largest first, without those that are zero.
template <class Values>
std::vector<Eigen::Index> by_size(const Values& nu) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(nu.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(nu[a]) > std::abs(nu[b]);
  });
  const double size = nu.size() > 0 ? nu.cwiseAbs().maxCoeff() : 0.0;
  while (!order.empty() && std::abs(nu[order.back()]) <= 1e2 * eps * size) order.pop_back();
  return order;
}

}  // namespace

InvertedPairs solve_dense(const ShiftedPencil& op) {
  const Eigen::Index n = op.inverse.size();
  const Eigen::MatrixXd B = op.inverse.dense(*op.pencil.B);
  // B = R R^T with as many columns as B has rank
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_B(B);
  const Eigen::VectorXd& d = of_B.eigenvalues();  // rising
  const double least = static_cast<double>(n) * eps * d[n - 1];
  const Eigen::Index rank = (d.array() > least).count();
  const Eigen::MatrixXd R =
      of_B.eigenvectors().rightCols(rank) * d.tail(rank).cwiseSqrt().asDiagonal();
  const Eigen::MatrixXd C = op.inverse.dense(*op.pencil.A) - op.shift * B;
  const Eigen::MatrixXd X = C.partialPivLu().solve(R);
  const Eigen::MatrixXd S = R.transpose() * X;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_S(0.5 * (S + S.transpose()));
  const auto order = by_size(of_S.eigenvalues());
  InvertedPairs pairs;
  pairs.nu = of_S.eigenvalues()(order);
  pairs.vectors = X * of_S.eigenvectors()(Eigen::all, order) * pairs.nu.cwiseInverse().asDiagonal();
  return pairs;
}

GeneralPairs solve_dense(const Operator& op) {
  Eigen::MatrixXd T(op.size, op.size);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(op.size);
  for (int j = 0; j < op.size; ++j) {
    unit[j] = 1.0;
    op.apply(unit, T.col(j));
    unit[j] = 0.0;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> of_T(T);
  const auto order = by_size(of_T.eigenvalues());
  return {of_T.eigenvalues()(order), of_T.eigenvectors()(Eigen::all, order)};
}

}  // namespace culm::solver
