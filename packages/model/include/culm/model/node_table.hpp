/// The nodes of a model and how their unknowns are reduced.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/node.hpp>
#include <culm/model/state.hpp>

#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace culm::model {

using NodeSlots = Slots<4>;

/// How the coordinates of an eliminated node follow from its master:
/// x = x_m + sum_k lever_k d_k,m and d_i = sum_k turn_ik d_k,m. A shell node that follows another
/// shell node has its position and its director. @source formulation 6.4, 6.5
struct RigidLink {
  int master = -1;
  Vec3 lever = Vec3::Zero();     ///< components in the master's triad [m]
  Mat3 turn = Mat3::Identity();  ///< turn(i, k) = d_i . d_k,m in the reference
};

/// Nodes in the order they were added. All have four slots in memory; of a shell node, x and d, the
/// last two are zero and belong to no unknown, so that whatever acts on slots acts on both kinds.
class NodeTable {
 public:
  /// Adds a node. @param slots reference slots, shape (3, 4): x, d1, d2, d3, or x, d, 0, 0
  /// @return node number
  int add(const NodeSlots& slots, NodeKind kind = NodeKind::node12);

  int size() const { return static_cast<int>(fixed_.size()); }
  /// First coordinate of a node in Coordinates.
  static int offset(int node) { return 12 * node; }
  const Coordinates& reference() const { return reference_; }

  /// Slots of a node in a configuration, shape (3, 4).
  static Eigen::Map<const NodeSlots> slots(const Coordinates& q, int node) {
    return Eigen::Map<const NodeSlots>(q.data() + offset(node));
  }
  static Eigen::Map<NodeSlots> slots(Coordinates& q, int node) {
    return Eigen::Map<NodeSlots>(q.data() + offset(node));
  }

  NodeKind kind(int node) const { return kinds_[index(node)]; }
  /// Whether the slots of a node turn with a triad: its own or that of its master.
  bool turns(int node) const { return kind(master(node)) == NodeKind::node12; }

  /// Takes away some of the six unknowns of a node: translations 0-2, rotations 3-5, of a shell
  /// node the components of its director 3-5.
  void fix(int node, std::bitset<6> unknowns) {
    fixed_[index(node)] |= static_cast<std::uint8_t>(unknowns.to_ulong());
  }
  std::bitset<6> fixed(int node) const { return fixed_[index(node)]; }

  /// Makes `slave` follow `master` rigidly. Chains are collapsed to one master.
  /// @return false when that would close a loop of links or give a node a second master
  bool link(int slave, int master);
  /// Whether a node has no unknowns of its own.
  bool is_slave(int node) const { return !link_of_.empty() && link_of_[index(node)] >= 0; }
  int num_slaves() const { return static_cast<int>(links_.size()); }
  /// The node whose unknowns move this one: its master, or itself.
  int master(int node) const { return is_slave(node) ? rigid_link(node).master : node; }
  /// @pre is_slave(node)
  const RigidLink& rigid_link(int node) const { return links_[index(link_of_[index(node)])]; }

  /// Recomputes an eliminated node from its master.
  void follow_master(int slave, Coordinates& q) const;
  /// Applies the increment of a Newton step to the six unknowns of a node. A triad turns, d_i <-
  /// Exp(dtheta) d_i, with one polar correction, so no rotation parameter is ever stored; a shell
  /// director changes by its increment. @source formulation 6.3
  void move(int node, const Vec6& increment, Coordinates& q) const;
  /// The increment of the six unknowns of a node by which `move` takes it from one configuration to
  /// another; rotations by less than pi.
  Vec6 motion(int node, const Coordinates& from, const Coordinates& to) const;
  /// The same for many nodes, which is faster. @param increments  one for each
  void move(std::span<const int> nodes, std::span<const Vec6> increments, Coordinates& q) const;
  void motions(std::span<const int> nodes, const Coordinates& from, const Coordinates& to,
               std::span<Vec6> motions) const;
  /// How the slots of a node move with its six unknowns at `q`, to first order: P u, shape (3, 4).
  NodeSlots slot_motion(int node, const Vec6& u, const Coordinates& q) const;
  /// The rates of the six unknowns that belong to slot rates `v` at `q`, for a triad v and
  /// omega = 1/2 sum_i d_i x w_i. @source formulation 1.1
  Vec6 unknown_motion(int node, const NodeSlots& v, const Coordinates& q) const;
  /// The same for many nodes, which is faster. @param rates  one for each
  void unknown_motions(std::span<const int> nodes, const Coordinates& v, const Coordinates& q,
                       std::span<Vec6> rates) const;

 private:
  static std::size_t index(int node) { return static_cast<std::size_t>(node); }
  RigidLink make_link(int slave, int master) const;

  Coordinates reference_;
  std::vector<NodeKind> kinds_;
  std::vector<std::uint8_t> fixed_;
  std::vector<int> link_of_;  // of each node among the links, or -1; empty without links
  std::vector<RigidLink> links_;
  std::unordered_map<int, std::vector<int>> slaves_;  // of each master
};

}  // namespace culm::model
