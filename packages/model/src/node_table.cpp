#include <culm/math/rotation.hpp>
#include <culm/model/node_table.hpp>

namespace culm::model {

int NodeTable::add(const NodeSlots& slots) {
  reference_.insert(reference_.end(), slots.data(), slots.data() + slots.size());
  fixed_.emplace_back();
  links_.emplace_back();
  return size() - 1;
}

RigidLink NodeTable::make_link(int slave, int master) const {
  const auto s = slots(reference_, slave);
  const auto m = slots(reference_, master);
  const Mat3 triad = m.rightCols<3>();
  RigidLink link;
  link.master = master;
  link.lever = triad.transpose() * (s.col(0) - m.col(0));
  link.turn = s.rightCols<3>().transpose() * triad;
  return link;
}

bool NodeTable::link(int slave, int master) {
  const int root = this->master(master);
  if (is_slave(slave) || root == slave) return false;
  links_[index(slave)] = make_link(slave, root);
  for (int node = 0; node < size(); ++node) {
    if (links_[index(node)].master == slave) links_[index(node)] = make_link(node, root);
  }
  return true;
}

void NodeTable::follow_master(int slave, Coordinates& q) const {
  const RigidLink& link = links_[index(slave)];
  const NodeSlots m = slots(q, link.master);
  auto s = slots(q, slave);
  s.col(0) = m.col(0) + m.rightCols<3>() * link.lever;
  s.rightCols<3>() = m.rightCols<3>() * link.turn.transpose();
}

void move_node(const Vec6& increment, Eigen::Map<NodeSlots> slots) {
  slots.col(0) += increment.head<3>();
  const Mat3 turned = exp_rotation(increment.tail<3>()) * slots.rightCols<3>();
  slots.rightCols<3>() = polar_correction(turned);
}

}  // namespace culm::model
