/// Derivatives by central differences.
#pragma once

#include <culm/math/types.hpp>

#include <type_traits>

namespace culm::kit {

/// Derivative of a vector function at x, shape (M, N); exact up to round-off for functions of
/// degree two, whatever the step.
/// @param f  maps Vec<N> to Vec<M>; a value, because an expression would outlive what it refers to
template <int M, int N, class F>
Mat<M, N> central_difference(F&& f, const Vec<N>& x, double step = 1e-6) {
  static_assert(std::is_same_v<decltype(f(x)), Vec<M>>);
  Mat<M, N> derivative;
  for (int k = 0; k < N; ++k) {
    Vec<N> ahead = x;
    Vec<N> behind = x;
    ahead[k] += step;
    behind[k] -= step;
    derivative.col(k) = (f(ahead) - f(behind)) / (2.0 * step);
  }
  return derivative;
}

/// The same for vectors whose sizes the compiler does not know.
/// @param f  maps Eigen::VectorXd to Eigen::VectorXd
template <class F>
Eigen::MatrixXd any_central_difference(F&& f, const Eigen::VectorXd& x, double step = 1e-6) {
  static_assert(std::is_same_v<decltype(f(x)), Eigen::VectorXd>);
  Eigen::MatrixXd derivative(f(x).size(), x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Eigen::VectorXd ahead = x;
    Eigen::VectorXd behind = x;
    ahead[k] += step;
    behind[k] -= step;
    derivative.col(k) = (f(ahead) - f(behind)) / (2.0 * step);
  }
  return derivative;
}

/// Largest difference between two matrices, relative to the largest entry of the second.
template <class A, class B>
double relative_difference(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace culm::kit
