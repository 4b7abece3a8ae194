#include <culm/math/fetch.hpp>
#include <culm/math/rotation.hpp>
#include <culm/mechanics/triad_pack.hpp>
#include <culm/model/node_table.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace culm::model {
namespace {

// Nodes whose coordinates are asked for before they are read.
constexpr std::size_t nodes_ahead = 16;

// Which of some nodes are in a pack.
using Lanes = std::array<std::size_t, pack_lanes>;

// Calls alone(i) for shell nodes, and together(lanes, count) for up to pack_lanes triads at once,
// the last of which is repeated where there are fewer.
template <class Alone, class Together>
void in_packs(const NodeTable& table, std::span<const int> nodes, Alone alone, Together together) {
  Lanes lanes{};
  std::size_t count = 0;
  const auto finish = [&] {
    if (count == 0) return;
    std::fill(lanes.begin() + static_cast<std::ptrdiff_t>(count), lanes.end(), lanes[count - 1]);
    together(lanes, count);
    count = 0;
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (table.kind(nodes[i]) != NodeKind::node12) {
      alone(i);
      continue;
    }
    lanes[count++] = i;
    if (count == pack_lanes) finish();
  }
  finish();
}

void gather(std::span<const int> nodes, const Lanes& lanes, const Coordinates& q,
            Packs<12>& slots) {
  std::array<const double*, pack_lanes> rows{};
  for (std::size_t l = 0; l < rows.size(); ++l) {
    rows[l] = q.data() + NodeTable::offset(nodes[lanes[l]]);
    const std::size_t later = std::min(lanes[l] + nodes_ahead, nodes.size() - 1);
    fetch(q.data() + NodeTable::offset(nodes[later]), 12 * sizeof(double));
  }
  to_lanes(rows, 12, slots.data());
}

// The six unknowns of each node that a function finds from two kinds of coordinates.
template <class Together, class Alone>
void find_in_packs(const NodeTable& table, std::span<const int> nodes, const Coordinates& first,
                   const Coordinates& second, Together find, Alone find_alone,
                   std::span<Vec6> found) {
  const auto together = [&](const Lanes& lanes, std::size_t count) {
    Packs<12> a, b;
    gather(nodes, lanes, first, a);
    gather(nodes, lanes, second, b);
    Packs<6> u;
    find(a, b, u);
    for (std::size_t l = 0; l < count; ++l) {
      for (int c = 0; c < 6; ++c) found[lanes[l]][c] = u.of(static_cast<int>(l), c);
    }
  };
  in_packs(
      table, nodes, [&](std::size_t i) { found[i] = find_alone(nodes[i]); }, together);
}

}  // namespace

int NodeTable::add(const NodeSlots& slots, NodeKind kind) {
  reference_.append({slots.data(), static_cast<std::size_t>(slots.size())});
  kinds_.push_back(kind);
  fixed_.emplace_back();
  if (!link_of_.empty()) link_of_.push_back(-1);
  return size() - 1;
}

RigidLink NodeTable::make_link(int slave, int master) const {
  const auto s = slots(reference_, slave);
  const auto m = slots(reference_, master);
  const Mat3 triad = m.rightCols<3>();
  RigidLink link;
  link.master = master;
  if (kind(master) == NodeKind::node6) {
    link.turn = Vec3::UnitX().asDiagonal();
    return link;
  }
  link.lever = triad.transpose() * (s.col(0) - m.col(0));
  link.turn = s.rightCols<3>().transpose() * triad;
  return link;
}

bool NodeTable::link(int slave, int master) {
  const int root = this->master(master);
  if (is_slave(slave) || root == slave) return false;
  // a triad cannot follow a director
  if (kind(slave) == NodeKind::node12 && kind(root) == NodeKind::node6) return false;
  std::vector<int>& led = slaves_[root];
  if (const auto handed_on = slaves_.extract(slave)) {
    for (const int node : handed_on.mapped()) {
      links_[index(link_of_[index(node)])] = make_link(node, root);
      led.push_back(node);
    }
  }
  led.push_back(slave);
  link_of_.resize(kinds_.size(), -1);
  link_of_[index(slave)] = static_cast<int>(links_.size());
  links_.push_back(make_link(slave, root));
  return true;
}

void NodeTable::follow_master(int slave, Coordinates& q) const {
  const RigidLink& link = rigid_link(slave);
  const NodeSlots m = slots(q, link.master);
  auto s = slots(q, slave);
  s.col(0) = m.col(0) + m.rightCols<3>() * link.lever;
  s.rightCols<3>() = m.rightCols<3>() * link.turn.transpose();
}

void NodeTable::move(int node, const Vec6& increment, Coordinates& q) const {
  auto s = slots(q, node);
  s.col(0) += increment.head<3>();
  if (kind(node) == NodeKind::node6) {
    s.col(1) += increment.tail<3>();
    return;
  }
  const Mat3 turned = exp_rotation(increment.tail<3>()) * s.rightCols<3>();
  s.rightCols<3>() = polar_correction(turned);
}

Vec6 NodeTable::motion(int node, const Coordinates& from, const Coordinates& to) const {
  const auto a = slots(from, node);
  const auto b = slots(to, node);
  Vec6 u;
  u.head<3>() = b.col(0) - a.col(0);
  if (kind(node) == NodeKind::node6) {
    u.tail<3>() = b.col(1) - a.col(1);
  } else {
    u.tail<3>() = log_rotation(b.rightCols<3>() * a.rightCols<3>().transpose());
  }
  return u;
}

void NodeTable::move(std::span<const int> nodes, std::span<const Vec6> increments,
                     Coordinates& q) const {
  const auto move_triads_of = [&](const Lanes& lanes, std::size_t count) {
    Packs<12> slots;
    gather(nodes, lanes, q, slots);
    Packs<6> u;
    for (std::size_t l = 0; l < pack_lanes; ++l) {
      for (int c = 0; c < 6; ++c) u.of(static_cast<int>(l), c) = increments[lanes[l]][c];
    }
    move_triads(u, slots);
    std::array<double, 12> repeated;
    std::array<double*, pack_lanes> rows;
    rows.fill(repeated.data());
    for (std::size_t l = 0; l < count; ++l) rows[l] = q.data() + offset(nodes[lanes[l]]);
    from_lanes(slots.data(), 12, rows);
  };
  in_packs(
      *this, nodes, [&](std::size_t i) { move(nodes[i], increments[i], q); }, move_triads_of);
}

void NodeTable::motions(std::span<const int> nodes, const Coordinates& from, const Coordinates& to,
                        std::span<Vec6> motions) const {
  find_in_packs(
      *this, nodes, from, to, find_motions, [&](int node) { return motion(node, from, to); },
      motions);
}

NodeSlots NodeTable::slot_motion(int node, const Vec6& u, const Coordinates& q) const {
  NodeSlots motion = NodeSlots::Zero();
  motion.col(0) = u.head<3>();
  if (kind(node) == NodeKind::node6) {
    motion.col(1) = u.tail<3>();
    return motion;
  }
  const auto s = slots(q, node);
  const Vec3 turn = u.tail<3>();
  for (int i = 1; i < 4; ++i) motion.col(i) = turn.cross(Vec3(s.col(i)));
  return motion;
}

Vec6 NodeTable::unknown_motion(int node, const NodeSlots& v, const Coordinates& q) const {
  Vec6 u;
  u.head<3>() = v.col(0);
  if (kind(node) == NodeKind::node6) {
    u.tail<3>() = v.col(1);
    return u;
  }
  const auto s = slots(q, node);
  u.tail<3>().setZero();
  for (int i = 1; i < 4; ++i) u.tail<3>() += 0.5 * Vec3(s.col(i)).cross(Vec3(v.col(i)));
  return u;
}

void NodeTable::unknown_motions(std::span<const int> nodes, const Coordinates& v,
                                const Coordinates& q, std::span<Vec6> rates) const {
  find_in_packs(
      *this, nodes, q, v, find_rates,
      [&](int node) { return unknown_motion(node, slots(v, node), q); }, rates);
}

}  // namespace culm::model
