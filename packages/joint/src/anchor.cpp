#include <culm/joint/anchor.hpp>

#include <Eigen/LU>

namespace culm::joint {

Anchor::Anchor(const model::NodeTable& nodes, const model::Marker& marker)
    : marker_(marker), q_(3, 4 * static_cast<int>(marker.nodes.size())) {
  int at = 0;
  for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
    const auto slots = model::NodeTable::slots(nodes.reference(), marker.nodes[a]);
    q_.middleCols<4>(at) = slots;
    position_ += marker.weights[a] * slots.col(0);
    directors_ += marker.weights[a] * slots.rightCols<3>();
    on_shell_ = on_shell_ || nodes.kind(marker.nodes[a]) == NodeKind::node6;
    at += 4;
  }
  // those of a node are orthonormal: the transpose is free of round-off
  components_ = node() >= 0 ? Mat3(directors_.transpose()) : Mat3(directors_.inverse());
}

Vec3 Anchor::across(const Vec3& axis) const {
  const Mat3 projections = directors_ - axis * (axis.transpose() * directors_);
  const Vec3 lengths = projections.colwise().norm().transpose();
  // of directors that are alike the first, whatever rounding made of them
  constexpr double alike = 1e-4;
  int longest = 0;
  while (lengths[longest] < lengths.maxCoeff() - alike) ++longest;
  return projections.col(longest).normalized();
}

model::SlotSum Anchor::attached(const Vec3& components) const {
  model::SlotSum factors(static_cast<std::size_t>(num_slots()), 0.0);
  for (std::size_t a = 0; a < marker_.weights.size(); ++a) {
    for (int k = 0; k < 3; ++k) {
      factors[4 * a + 1 + static_cast<std::size_t>(k)] = marker_.weights[a] * components[k];
    }
  }
  return factors;
}

model::SlotSum Anchor::point(const Vec3& offset) const {
  model::SlotSum factors = attached(offset);
  for (std::size_t a = 0; a < marker_.weights.size(); ++a) factors[4 * a] = marker_.weights[a];
  return factors;
}

model::SlotSum Anchor::vector(const Vec3& v) const { return attached(components_ * v); }

}  // namespace culm::joint
