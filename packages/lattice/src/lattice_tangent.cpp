// The derivative of the forces of a lattice by the motion of all nodes that carry it.
#include <culm/lattice/lattice_load.hpp>
#include <culm/load/slot_kernel.hpp>

#include <algorithm>

namespace culm::lattice {

void LatticeLoad::add_carriers() {
  for (const Item& item : items_) {
    carriers_.insert(carriers_.end(), item.nodes.begin(), item.nodes.end());
  }
  std::ranges::sort(carriers_);
  carriers_.erase(std::unique(carriers_.begin(), carriers_.end()), carriers_.end());
  carried_.resize(carriers_.size());
  for (const Item& item : items_) {
    for (std::size_t a = 0; a < item.nodes.size(); ++a) {
      const auto carrier = std::ranges::lower_bound(carriers_, item.nodes[a]) - carriers_.begin();
      for (std::size_t k = 0; k < item.points.size(); ++k) {
        carried_[static_cast<std::size_t>(carrier)].emplace_back(
            item.points[k], item.factors[k].segment<4>(4 * static_cast<Eigen::Index>(a)));
      }
    }
  }
}

// Column by column: a slot moves the points that hang on it, and the forces of all points go back
// to the slots.
void LatticeLoad::find_stiffness(const model::State& state) {
  const FluidResult& result = result_at(state);
  GridStep grid;
  if (step_ > 0.0) {
    grid = step_to(state);
  } else {
    grid.start = grid.end = this->grid(state.next);
  }
  const auto size = 12 * static_cast<Eigen::Index>(carriers_.size());
  stiffness_.setZero(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const Eigen::Index slot = column % 12 / 3, component = column % 3;
    Points change(grid.end.size());
    for (const auto& [point, factors] : carried_[static_cast<std::size_t>(column / 12)]) {
      change.add(point, factors[slot] * Vec3::Unit(component));
    }
    const Points forces = lattice_.change_of_forces(result, accepted_.circulation, grid, change);
    for (std::size_t a = 0; a < carriers_.size(); ++a) {
      Mat<3, 4> at_slots = Mat<3, 4>::Zero();
      for (const auto& [point, factors] : carried_[a]) {
        at_slots -= forces.at(point) * factors.transpose();
      }
      stiffness_.col(column).segment<12>(12 * static_cast<Eigen::Index>(a)) = at_slots.reshaped();
    }
  }
  knows_stiffness_ = true;
}

template <class Space>
Verdict LatticeLoad::assemble_coupling(std::size_t i, const model::State& state,
                                       const Stencil& stencil, model::Target& target) const {
  using Motion = model::ItemMotion<1>;
  std::vector<Motion> motions;
  motions.reserve(carriers_.size());
  for (const int node : carriers_)
    motions.emplace_back(nodes_, std::vector{node}, state, stencil.theta);
  const auto count = static_cast<int>(carriers_.size());
  for (int a = 0; a < count; ++a) {
    for (int b = 0; b < count; ++b) {
      RowMat<Space::width, Space::width> block = RowMat<Space::width, Space::width>::Zero();
      const Mat<12, 12> K = stiffness_.block<12, 12>(12 * a, 12 * b);
      load::add_slot_tangent<Space>(K, motions[static_cast<std::size_t>(a)].arms_mid[0],
                                    motions[static_cast<std::size_t>(b)].arms_next[0], block);
      placement().scatter.add_tangent(i, a, b, block, target);
    }
  }
  return Verdict::ok;
}

template Verdict LatticeLoad::assemble_coupling<model::NullSpace>(std::size_t, const model::State&,
                                                                  const Stencil&,
                                                                  model::Target&) const;
template Verdict LatticeLoad::assemble_coupling<model::FullSpace>(std::size_t, const model::State&,
                                                                  const Stencil&,
                                                                  model::Target&) const;

}  // namespace culm::lattice
