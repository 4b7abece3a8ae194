/// The turn of a node about an axis in a step, and moments about that axis.
#pragma once

#include <culm/model/projection.hpp>

namespace culm::joint {

/// An axis through a node.
struct TurnAxis {
  Vec3 components = Vec3::UnitZ();  ///< unit length, in space or in the directors
  bool follows = false;             ///< turns with the directors
};

/// n . tau with the Cayley vector tau of a step, 2 tan(angle / 2) for a rotation about n alone, and
/// a unit moment about n, as the unknowns of the node see them. A following axis is that of the
/// mean directors, n = nu_k d_k,1/2 / |.|. The moment does the work moment . Dq = n . tau where it
/// acts at the middle of the step. @source formulation 2.4, 3.1
template <class Space>
struct AxisTurn {
  static constexpr int width = Space::width;

  /// @param theta where the moment acts
  AxisTurn(const TurnAxis& turn_axis, const Mat3& prev, const Mat3& next, double theta);

  Vec3 axis;                        ///< n
  double turn = 0.0;                ///< n . tau
  Vec<width> moment;                ///< a unit moment about n
  Vec<width> gradient;              ///< of the turn, by the unknowns at the end of the step
  RowMat<width, width> derivative;  ///< of the moment, by the unknowns at the end of the step
};

extern template struct AxisTurn<model::NullSpace>;
extern template struct AxisTurn<model::FullSpace>;

}  // namespace culm::joint
