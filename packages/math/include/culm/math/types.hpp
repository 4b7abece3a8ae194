/// The linear-algebra vocabulary of the kernels: fixed-size Eigen types, nothing on the heap.
#pragma once

#include <Eigen/Core>

#include <concepts>
#include <cstddef>

namespace culm {

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;
template <int R, int C>
using Mat = Eigen::Matrix<double, R, C>;
/// Row-major, so that the columns of one row are contiguous: vector instructions run along a row.
template <int R, int C>
using RowMat = Eigen::Matrix<double, R, C, C == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

using Vec3 = Vec<3>;
using Vec6 = Vec<6>;
using Mat3 = Mat<3, 3>;
using Mat6 = Mat<6, 6>;

/// A place in a container of the standard library, which counts without sign.
template <std::integral Int>
constexpr std::size_t index(Int i) {
  return static_cast<std::size_t>(i);
}

/// The axis after one of three, in turn.
constexpr int next_axis(int i) { return (i + 1) % 3; }

/// Skew matrix [a] with [a] b = a x b.
inline Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

}  // namespace culm
