/// Numbers at points as vectors of Eigen.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace culm::coupling {

inline Eigen::VectorXd as_vector(std::span<const double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// The first three of six numbers per point: the translations of motions, the forces of loads.
inline Eigen::VectorXd translations(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> all(
      values.data(), 6, static_cast<Eigen::Index>(values.size() / 6));
  return all.topRows<3>().reshaped();
}

}  // namespace culm::coupling
