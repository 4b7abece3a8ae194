#include <culm/math/rotation.hpp>
#include <culm/model/node_table.hpp>

#include <Eigen/Geometry>

namespace culm::model {

int NodeTable::add(const NodeSlots& slots, NodeKind kind) {
  reference_.append({slots.data(), static_cast<std::size_t>(slots.size())});
  kinds_.push_back(kind);
  fixed_.emplace_back();
  link_of_.push_back(-1);
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
  for (int node = 0; node < size(); ++node) {
    if (is_slave(node) && this->master(node) == slave) {
      links_[index(link_of_[index(node)])] = make_link(node, root);
    }
  }
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

}  // namespace culm::model
