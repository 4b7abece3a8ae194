/// Values of unknowns by blocks, for the parts of System.
#pragma once

#include <culm/model/model.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace culm::assembly {

/// What a sum over ranks adds to a value without changing it: x + -0 is x also where x is a zero.
constexpr double nothing = -0.0;

/// What the value of an own unknown changes by for one of its column.
inline double own_scale(const model::OwnUnknown& unknown, double multiplier_scale) {
  return unknown.kind == model::UnknownKind::multiplier ? multiplier_scale : unknown.scale;
}

/// Unknowns of a block as kernels write them, zero where supports took them away.
inline std::array<double, 12> unknowns_of(const model::BlockShape& shape, int first_column,
                                          std::span<const double> values, double factor) {
  std::array<double, 12> u{};
  for (int i = 0; i < shape.width; ++i) {
    const int at = shape.position[index(i)];
    if (at >= 0) u[index(i)] = factor * values[index(first_column + at)];
  }
  return u;
}

/// P u: how the slots of the node of a block move with its unknowns, to first order.
inline model::NodeSlots slot_motion(const model::Model& model, int node,
                                    const std::array<double, 12>& u, const model::Coordinates& q) {
  if (model.unknowns().form() == model::Form::multipliers) {
    return Eigen::Map<const model::NodeSlots>(u.data());
  }
  return model.nodes().slot_motion(node, Eigen::Map<const Vec6>(u.data()), q);
}

}  // namespace culm::assembly
