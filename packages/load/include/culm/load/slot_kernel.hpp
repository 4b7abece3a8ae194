/// What loads on slots share: tangents of any shape, and the work of the forces of an item.
#pragma once

#include <culm/model/batch.hpp>
#include <culm/model/item_motion.hpp>

#include <Eigen/Geometry>

#include <vector>

namespace culm::load {

/// block += P_theta^T K P_next for the derivative K of the slot forces of one node by the slots of
/// another, shape (12, 12).
template <class Space, class Block>
void add_slot_tangent(const Mat<12, 12>& K, const model::Arms<4>& arms_mid,
                      const model::Arms<4>& arms_next, Block& block) {
  Mat<Space::width, 12> rows;
  Space::reduce_rows(K, arms_mid, rows);
  const Mat<12, Space::width> columns = rows.transpose();
  Mat<Space::width, Space::width> reduced;
  Space::reduce_rows(columns, arms_next, reduced);
  block += reduced.transpose();
}

/// Adds what the external slot forces of an item do in a step; their work only if `works`.
template <class Motion, class Forces>
void add_item_work(const Forces& forces, const Motion& motion, const std::vector<int>& nodes,
                   const model::State& state, bool works, model::StepWork& work) {
  for (int s = 0; s < forces.cols(); ++s) {
    const int node = nodes[static_cast<std::size_t>(s / 4)];
    const Vec3 f = forces.col(s);
    const Vec3 moved = motion.next.col(s) - model::NodeTable::slots(state.prev, node).col(s % 4);
    if (works) work.external += moved.dot(f);
    if (s % 4 == 0) work.force += f;
    work.moment += Vec3(motion.mid.col(s)).cross(f);
  }
}

}  // namespace culm::load
