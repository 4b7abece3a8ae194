/// Values of unknowns by blocks, for the parts of System.
#pragma once

#include <culm/model/model.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace culm::assembly {

/// What a sum over ranks adds to a value without changing it: x + -0 is x also where x is a zero.
constexpr double nothing = -0.0;

inline Eigen::Map<const Eigen::VectorXd> as_vector(std::span<const double> numbers) {
  return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
}

/// Largest size of those that are numbers; 0 if there are none.
inline double largest_size(std::span<const double> numbers) {
  return numbers.empty() ? 0.0 : as_vector(numbers).cwiseAbs().maxCoeff<Eigen::PropagateNumbers>();
}

/// What the value of an own unknown changes by for one of its column.
inline double own_scale(const model::OwnUnknown& unknown, double multiplier_scale) {
  return unknown.kind == model::UnknownKind::multiplier ? multiplier_scale : unknown.scale;
}

/// Unknowns of a block as kernels write them, zero where supports took them away.
/// @param values  from those of the block on
inline std::array<double, 12> unknowns_of(const model::BlockShape& shape,
                                          std::span<const double> values, double factor) {
  std::array<double, 12> u{};
  for (int i = 0; i < shape.width; ++i) {
    const int at = shape.position[index(i)];
    if (at >= 0) u[index(i)] = factor * values[index(at)];
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

/// Moves nodes, several at a time; all of them are where they belong when it ends.
class NodeMoves {
 public:
  NodeMoves(const model::NodeTable& nodes, model::Coordinates& q) : nodes_(nodes), q_(q) {}
  ~NodeMoves() { finish(); }
  NodeMoves(const NodeMoves&) = delete;
  NodeMoves& operator=(const NodeMoves&) = delete;

  void add(int node, const Vec6& increment) {
    waiting_[count_] = node;
    increments_[count_] = increment;
    if (++count_ == waiting_.size()) finish();
  }

 private:
  void finish() {
    nodes_.move(std::span(waiting_).first(count_), std::span(increments_).first(count_), q_);
    count_ = 0;
  }

  const model::NodeTable& nodes_;
  model::Coordinates& q_;
  std::size_t count_ = 0;
  std::array<int, 64> waiting_;
  std::array<Vec6, 64> increments_;
};

}  // namespace culm::assembly
