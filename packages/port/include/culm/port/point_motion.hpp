/// Where material points are and how they move.
#pragma once

#include <culm/load/couple.hpp>
#include <culm/mechanics/node.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/structure.hpp>

#include <array>

namespace culm::port {

/// x = sum_a N_a (x_a + sum_k offset_k d_k,a), linear in the coordinates: of rates the velocity.
Vec3 position(const model::Marker& point, const model::Coordinates& q);

/// sum_a N_a d_k,a, not orthonormal between nodes that are turned against each other; of rates how
/// they change. Of a shell the first column is its director and the others are zero.
Mat3 directors(const model::Marker& point, const model::Coordinates& q);

/// Kind of the nodes of a point. @pre all are of one kind
NodeKind kind_of(const model::Marker& point, const model::NodeTable& nodes);

/// A point as plain numbers, for passes over many.
class FlatPoint {
 public:
  static constexpr int max_nodes = 4;

  FlatPoint(const model::Marker& point, const model::NodeTable& nodes);

  NodeKind kind() const { return kind_; }
  /// sum_a N_a (x, d1, d2, d3)_a, shape (3, 4).
  model::NodeSlots slots(const model::Coordinates& q) const {
    model::NodeSlots sum = weights_[0] * at(q, 0);
    for (int a = 1; a < count_; ++a) sum += weights_[static_cast<std::size_t>(a)] * at(q, a);
    return sum;
  }
  /// The same of the difference of two configurations, without loss of digits.
  model::NodeSlots change(const model::Coordinates& from, const model::Coordinates& to) const {
    model::NodeSlots sum = weights_[0] * (at(to, 0) - at(from, 0));
    for (int a = 1; a < count_; ++a) {
      sum += weights_[static_cast<std::size_t>(a)] * (at(to, a) - at(from, a));
    }
    return sum;
  }
  /// Where the point is if its slots are these; of rates its velocity.
  Vec3 place(const model::NodeSlots& slots) const {
    return slots.col(0) + slots.rightCols<3>() * offset_;
  }
  /// The rotation from the reference to these directors: between the triads nearest to them; of a
  /// shell the one that turns the director on the shortest way.
  Mat3 rotation(const Mat3& directors) const;
  /// The rotation vector of moments, |tau| = 2 tan(angle / 2), of a change of the slots, or the
  /// angular velocity of their rates. @param middle  the slots there @see load::Couple
  Vec3 turn(const model::NodeSlots& middle, const model::NodeSlots& change) const {
    return load::couple_rotation(middle.rightCols<3>(), change.rightCols<3>(), kind_);
  }

 private:
  Eigen::Map<const model::NodeSlots> at(const model::Coordinates& q, int a) const {
    return Eigen::Map<const model::NodeSlots>(q.data() + firsts_[static_cast<std::size_t>(a)]);
  }

  NodeKind kind_;
  int count_;
  std::array<int, max_nodes> firsts_ = {};  // coordinates of the nodes
  std::array<double, max_nodes> weights_ = {};
  Vec3 offset_;
  Mat3 reference_;  // triad there, of a shell its director
};

}  // namespace culm::port
