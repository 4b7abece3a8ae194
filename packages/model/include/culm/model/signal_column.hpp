/// The column of the tangent by which forces follow a signal.
#pragma once

#include <culm/model/own_unknowns.hpp>
#include <culm/model/scatter.hpp>

namespace culm::model {

/// Adds the derivative of the residual of block a of an item by a signal whose block is b.
/// @param derivative  by the value of the signal, as long as block a is wide
template <class Derived>
void add_signal_column(const Scatter& scatter, std::size_t item, int a, int b, const Signal& signal,
                       double theta, const Eigen::MatrixBase<Derived>& derivative, Target& target) {
  Mat<Derived::RowsAtCompileTime, 12> columns = Mat<Derived::RowsAtCompileTime, 12>::Zero();
  columns.col(signal.place) = signal.weight(theta) * derivative;
  scatter.add_tangent(item, a, b, columns, target);
}

}  // namespace culm::model
