// The derivative of the forces of a lattice by the motion of all nodes that carry it.
#include <culm/lattice/lattice_load.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/model/size_budget.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

LatticeLoad::SlotMotions LatticeLoad::motions_of_slots() const {
  const auto rows = 3 * static_cast<Eigen::Index>(lattice_.bound().num_points());
  SlotMotions all;
  std::vector<Eigen::VectorXd> columns;
  const auto count = 12 * static_cast<Eigen::Index>(carriers_.size());
  for (Eigen::Index slot = 0; slot < count; ++slot) {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(rows);
    for (const auto& [point, factors] : carried_[static_cast<std::size_t>(slot / 12)]) {
      motion[3 * static_cast<Eigen::Index>(point) + slot % 3] = factors[slot % 12 / 3];
    }
    if (motion.isZero(0.0)) continue;
    all.slots.push_back(slot);
    columns.push_back(std::move(motion));
  }
  all.motions.resize(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t m = 0; m < columns.size(); ++m) {
    all.motions.col(static_cast<Eigen::Index>(m)) = columns[m];
  }
  return all;
}

// Of all slots: damping, mass, stiffness and lags with what finds them; of the unknowns: the lags
// as matrices of the model, and as complex ones of its eigenproblem.
void LatticeLoad::refuse_large_linearisation() const {
  constexpr double number = 8.0, entry = 16.0, complex_entry = 24.0;
  constexpr double lags = 9.0, others = 8.0;
  constexpr double slots = 12.0 * 12.0, unknowns = 6.0 * 6.0;
  const auto nodes = static_cast<double>(carriers_.size());
  model::MemoryNeed need;
  need.elements = nodes * nodes *
                  (number * (lags + others) * slots + (entry + complex_entry) * lags * unknowns);
  model::refuse_above(
      allowed_, need,
      fmt::format("couples {:.0f} nodes with each other by lags of the air, which in modes", nodes),
      where_);
}

const LaggedAir& LatticeLoad::air_at(const model::State& state) const {
  if (std::ranges::equal(linearised_, state.next) && linearised_at_ == state.time) return air_;
  refuse_large_linearisation();
  const SlotMotions moving = motions_of_slots();
  air_ =
      fit_lags(lattice_.small_motions(result_at(state), grid(state.next),
                                      lattice_.flow().time_at_level(state.time), moving.motions));
  const auto size = 12 * static_cast<Eigen::Index>(carriers_.size());
  const auto spread = [&](Eigen::MatrixXd& matrix) {
    Eigen::MatrixXd between_all = Eigen::MatrixXd::Zero(size, size);
    between_all(moving.slots, moving.slots) = matrix;
    matrix = std::move(between_all);
  };
  spread(air_.damping);
  spread(air_.mass);
  for (LaggedAir::Lag& lag : air_.lags) spread(lag.stiffness);
  linearised_ = state.next;
  linearised_at_ = state.time;
  return air_;
}

std::vector<double> LatticeLoad::delays(const model::State& state) const {
  std::vector<double> times;
  if (tangent_ != LatticeTangent::whole) return times;
  for (const LaggedAir::Lag& lag : air_at(state).lags) times.push_back(lag.time);
  return times;
}

Verdict LatticeLoad::assemble_delayed(const model::State& state, const Stencil& stencil,
                                      double delay, model::Target& target) {
  Verdict verdict = Verdict::ok;
  if (tangent_ != LatticeTangent::whole) return verdict;
  for (const LaggedAir::Lag& lag : air_at(state).lags) {
    if (!(std::abs(lag.time - delay) <= model::same_delay * delay)) continue;
    verdict = worse(verdict, assemble_coupling(lag.stiffness, state, stencil, target));
  }
  return verdict;
}

Verdict LatticeLoad::assemble_coupling(const Eigen::MatrixXd& matrix, const model::State& state,
                                       const Stencil& stencil, model::Target& target) const {
  if (!matrix.allFinite()) return Verdict::not_finite;
  return assemble_items([&](auto space, std::size_t i) {
    if (!is_coupling(placement().items[i])) return Verdict::ok;
    return assemble_coupling<decltype(space)>(i, matrix, state, stencil, target);
  });
}

template <class Space>
Verdict LatticeLoad::assemble_coupling(std::size_t i, const Eigen::MatrixXd& matrix,
                                       const model::State& state, const Stencil& stencil,
                                       model::Target& target) const {
  using Motion = model::ItemMotion<1>;
  std::vector<Motion> motions;
  motions.reserve(carriers_.size());
  for (const int node : carriers_)
    motions.emplace_back(nodes_, std::vector{node}, state, stencil.theta);
  const auto count = static_cast<int>(carriers_.size());
  for (int a = 0; a < count; ++a) {
    for (int b = 0; b < count; ++b) {
      RowMat<Space::width, Space::width> block = RowMat<Space::width, Space::width>::Zero();
      const Mat<12, 12> K = matrix.block<12, 12>(12 * a, 12 * b);
      load::add_slot_tangent<Space>(K, motions[static_cast<std::size_t>(a)].arms_mid[0],
                                    motions[static_cast<std::size_t>(b)].arms_next[0], block);
      placement().scatter.add_tangent(i, a, b, block, target);
    }
  }
  return Verdict::ok;
}

}  // namespace culm::lattice
