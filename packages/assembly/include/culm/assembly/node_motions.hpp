/// What multigrid wants to know of the unknowns behind a matrix.
#pragma once

#include <culm/math/types.hpp>

#include <Eigen/Core>

#include <vector>

namespace culm::assembly {

/// The unknowns of a rank by blocks, and how a rigid motion of the whole model moves them: the
/// directions in which a structure that nothing holds has no stiffness.
struct NodeMotions {
  /// A row for each unknown; three translations and three rotations about the origin.
  using Rigid = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  std::vector<int> widths;  ///< unknowns of each block, in the order of the rows
  Rigid rigid;              ///< zero in unknowns that are no motions
  /// Of each block: where its node is, and the director of a node that has one, as those of shells
  /// have; zero elsewhere.
  std::vector<Vec3> places, normals;
};

}  // namespace culm::assembly
