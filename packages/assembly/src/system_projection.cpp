#include <culm/assembly/system.hpp>
#include <culm/base/error.hpp>
#include <culm/model/massless.hpp>

#include "block_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::assembly {
namespace {

// Share of the largest change of a velocity that is rounding.
constexpr double negligible = 1e-9;

}  // namespace

double System::project_position(model::State& state, const Solve& solve_mass) {
  const model::Coordinates start = state.next;
  const Stencil stencil = Stencil::statics();
  prepare(state, stencil);
  // coordinates are rounded to epsilon times their size
  double size = model_.length();
  for (const double x : start) size = std::max(size, std::abs(x));
  size = comm_.max(size);
  constexpr int most_iterations = 50;
  for (int iteration = 0;; ++iteration) {
    const Evaluation found = evaluate(state, stencil, Want::residual);
    if (found.constraint_violation <= 1e-14) break;
    if (iteration == most_iterations || !std::isfinite(found.constraint_violation)) {
      return std::numeric_limits<double>::infinity();
    }
    Vector rhs = residual_;
    evaluate(state, stencil, Want::mass);
    const auto b = rhs.values();
    for (std::size_t row = 0; row < b.size(); ++row) b[row] = is_force_row(row) ? 0.0 : -b[row];
    Vector change(layout_.rows());
    solve_mass(rhs, change);
    const auto u = change.values();
    // its multipliers are no forces
    std::ranges::fill(u.subspan(index(num_force_rows())), 0.0);
    const bool stalls = change.largest() < 1e-15 * size;
    move(state, change, 1.0);
    if (stalls) break;  // at round-off
  }
  double largest = 0.0;
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block block = model_.unknowns().block(local.block);
    if (block.kind != model::BlockKind::node) continue;
    const auto change = model::NodeTable::slots(state.next, block.owner) -
                        model::NodeTable::slots(start, block.owner);
    largest = std::max(largest, change.cwiseAbs().maxCoeff());
  }
  state.prev = state.next;
  forget_reactions();
  return comm_.max(largest);
}

NodeMotions System::node_motions() const {
  const model::Coordinates& q =
      tangent_point_.empty() ? model_.nodes().reference() : tangent_point_;
  NodeMotions motions;
  motions.rigid.setZero(static_cast<Eigen::Index>(layout_.rows().size()), 6);
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    if (!local.owned) continue;
    const model::Block block = model_.unknowns().block(local.block);
    if (block.shape.active == 0) continue;
    motions.widths.push_back(block.shape.active);
    motions.places.push_back(Vec3::Zero());
    motions.normals.push_back(Vec3::Zero());
    if (block.kind != model::BlockKind::node) continue;
    const model::NodeSlots slots = model::NodeTable::slots(q, block.owner);
    motions.places.back() = slots.col(0);
    if (slots.rightCols<2>().isZero(0.0)) motions.normals.back() = slots.col(1);
    for (int k = 0; k < 6; ++k) {
      const Vec3 axis = Vec3::Unit(k % 3);
      model::NodeSlots rate = model::NodeSlots::Zero();
      if (k < 3) {
        rate.col(0) = axis;
      } else {
        for (int s = 0; s < rate.cols(); ++s) rate.col(s) = axis.cross(slots.col(s));
      }
      const Vec6 unknowns = model_.nodes().unknown_motion(block.owner, rate, q);
      const bool is_full = model_.unknowns().form() == model::Form::multipliers;
      for (int i = 0; i < block.shape.width; ++i) {
        const int place = block.shape.position[index(i)];
        if (place < 0) continue;
        motions.rigid(local.first_column + place, k) = is_full ? rate(i % 3, i / 3) : unknowns[i];
      }
    }
  }
  return motions;
}

void System::motions(const model::State& state, std::size_t first, std::span<Vec6> motions) const {
  const auto nodes = std::span(moving_nodes_).subspan(first, motions.size());
  model_.nodes().motions(nodes, state.prev, state.next, motions);
}

void System::velocities(const model::State& state, std::size_t first,
                        std::span<Vec6> velocities) const {
  const auto nodes = std::span(moving_nodes_).subspan(first, velocities.size());
  model_.nodes().unknown_motions(nodes, state.velocity, state.prev, velocities);
}

void System::move_nodes(model::State& state, const MotionSource& tell) const {
  const model::UnknownTable& unknowns = model_.unknowns();
  std::array<Vec6, 128> some;
  for (std::size_t first = 0; first < moving_nodes_.size(); first += some.size()) {
    const std::size_t count = std::min(some.size(), moving_nodes_.size() - first);
    const auto nodes = std::span(moving_nodes_).subspan(first, count);
    const auto motions = std::span(some).first(count);
    tell(first, motions);
    for (std::size_t i = 0; i < count; ++i) {
      const model::BlockShape& shape = unknowns.block(unknowns.node_block(nodes[i])).shape;
      for (int c = 0; c < 6 && shape.width == 6; ++c) {
        if (shape.position[index(c)] < 0) motions[i][c] = 0.0;
      }
    }
    model_.nodes().move(nodes, motions, state.next);
  }
  for (int slave : slaves_) model_.nodes().follow_master(slave, state.next);
  if (needs_all_nodes_) complete(state.next);
}

void System::save(const Motions& motions, std::string_view name, Snapshot& snapshot) const {
  if (snapshot.is_for_memory()) {
    std::vector<double> numbers;
    for (const Vec6& motion : motions) numbers.insert(numbers.end(), motion.begin(), motion.end());
    snapshot.set(name, std::move(numbers));
    return;
  }
  save_nodes([this, &motions] { return own_motions(motions); }, 6, name, snapshot);
}

// Those of all nodes of this rank; zero where a node does not move.
std::vector<double> System::own_motions(const Motions& motions) const {
  std::vector<double> own;
  own.reserve(6 * owned_nodes_.size());
  auto node = owned_nodes_.begin();
  const auto add_still = [&](auto end) {
    for (; node != end; ++node) own.insert(own.end(), 6, 0.0);
  };
  for (std::size_t i = 0; i < num_own_motions_; ++i) {
    add_still(std::find(node, owned_nodes_.end(), moving_nodes_[i]));
    own.insert(own.end(), motions[i].begin(), motions[i].end());
    ++node;
  }
  add_still(owned_nodes_.end());
  return own;
}

System::Motions System::restore_motions(const Snapshot& snapshot, std::string_view name) const {
  std::vector<double> numbers = snapshot.copy(name);
  Motions motions;
  if (snapshot.is_for_memory()) {
    for (std::size_t i = 0; i < numbers.size(); i += 6) {
      motions.push_back(Eigen::Map<const Vec6>(numbers.data() + i));
    }
    return motions;
  }
  numbers.resize(6 * index(model_.nodes().size()));
  comm_.broadcast(std::span<double>(numbers));
  for (const int node : moving_nodes_) {
    motions.push_back(Eigen::Map<const Vec6>(numbers.data() + 6 * node));
  }
  return motions;
}

// dg/dt of all constraint rows at state.time: h = h_q - g, so g is what h loses while q stays.
// Second-order differences; zero without work when nothing is driven.
std::vector<double> System::drive_speed(model::State& state, double probe) {
  std::vector<double> speed(layout_.rows().size(), 0.0);
  const auto& equations = model_.equations();
  if (std::none_of(equations.begin(), equations.end(),
                   [](const model::Constraint& c) { return static_cast<bool>(c.drive); })) {
    return speed;
  }
  const double time = state.time;
  for (const auto& [fraction, weight] : {std::pair{1.0, 1.0}, {0.5, -4.0}, {0.0, 3.0}}) {
    state.time = time + fraction * probe;
    prepare(state, Stencil::statics());
    evaluate(state, Stencil::statics(), Want::residual);
    const auto h = std::as_const(residual_).values();
    for (std::size_t row = 0; row < speed.size(); ++row) speed[row] += weight / probe * h[row];
  }
  return speed;
}

// The largest of all ranks, and what it belongs to there; the lowest where several are equal.
std::pair<double, int> System::find_largest(double value, int place) const {
  const double largest = comm_.max(value);
  const double far = std::numeric_limits<int>::max();
  const double first = -comm_.max(value == largest && place >= 0 ? -place : -far);
  return {largest, first < far ? static_cast<int>(first) : -1};
}

// The equation with the largest entry in its rows; -1 if none is above `largest`.
int System::largest_equation(std::span<const double> rows, double largest) const {
  int equation = -1;
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block block = model_.unknowns().block(local.block);
    if (!local.owned || block.kind != model::BlockKind::multipliers) continue;
    for (int i = 0; i < block.shape.active; ++i) {
      const double entry = std::abs(rows[index(local.first_column + i)]);
      if (entry <= largest) continue;
      largest = entry;
      equation = block.owner;
    }
  }
  return find_largest(largest, equation).second;
}

VelocityFit System::project_velocity(model::State& state, double probe, const Solve& solve_mass,
                                     model::Coordinates& fitted) {
  // velocities given to eliminated nodes are those of their masters
  std::vector<model::NodeSlots> given;
  for (int slave : slaves_) {
    given.push_back(model::NodeTable::slots(state.velocity, slave));
    model_.nodes().follow_master(slave, state.velocity);
  }
  const std::vector<double> speed = drive_speed(state, probe);
  const Evaluation found = evaluate(state, Stencil::statics(), Want::mass);
  if (found.verdict != Verdict::ok) {
    throw NonFiniteError(
        "The mass is not finite at the beginning of the motion.\n"
        "Likely cause: a mass, a length, a damping or a flow beyond the range of numbers.\n"
        "Try: check units and functions.");
  }
  const model::UnknownTable& unknowns = model_.unknowns();
  const bool null_space = unknowns.form() == model::Form::null_space;
  Vector velocity(layout_.rows());
  const auto u = velocity.values();
  const auto each_unknown = [&](auto action) {
    for (const Layout::LocalBlock& local : layout_.local_blocks()) {
      const model::Block block = unknowns.block(local.block);
      if (block.kind != model::BlockKind::node) continue;
      action(local, block);
    }
  };
  each_unknown([&](const Layout::LocalBlock& local, const model::Block& block) {
    if (!local.owned) return;
    const auto slots = model::NodeTable::slots(state.velocity, block.owner);
    const Vec6 rigid = model_.nodes().unknown_motion(block.owner, slots, state.prev);
    for (int i = 0; i < block.shape.width; ++i) {
      const int at = block.shape.position[index(i)];
      if (at >= 0) u[index(local.first_column + at)] = null_space ? rigid[i] : slots.data()[i];
    }
  });
  // only the constraint rows are out of balance: H v = dg/dt
  Vector rhs(layout_.rows());
  matrix_->multiply(velocity, rhs);
  const auto b = rhs.values();
  const auto rates = std::as_const(residual_).values();  // by drives of angular velocities
  for (std::size_t row = 0; row < b.size(); ++row)
    b[row] = is_force_row(row) ? 0.0 : speed[row] - rates[row] - b[row];
  // nobody knows how fast a signal changes that leads, so what it leads stays as it is
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block block = unknowns.block(local.block);
    if (!local.owned || block.kind != model::BlockKind::multipliers) continue;
    if (!model_.equations()[index(block.owner)].follow) continue;
    for (int i = 0; i < block.shape.active; ++i) b[index(local.first_column + i)] = 0.0;
  }
  Vector change(layout_.rows());
  solve_mass(rhs, change);
  velocity.update(1.0, change);

  const ColumnValues all = column_values(velocity);
  fitted.assign(state.velocity.size(), 0.0);
  each_unknown([&](const Layout::LocalBlock& local, const model::Block& block) {
    const auto w = unknowns_of(block.shape, all.from(local.first_column), 1.0);
    model::NodeTable::slots(fitted, block.owner) = slot_motion(model_, block.owner, w, state.next);
  });
  for (int slave : slaves_) model_.nodes().follow_master(slave, fitted);
  if (needs_all_nodes_) complete(fitted);
  // what moves no mass, such as the frame of a linear shell, has no velocity of its own
  std::vector<bool> moves_mass = model::slots_with_mass(model_);
  for (int slave : slaves_) {
    for (std::size_t s = 0; s < 4; ++s) {
      if (!moves_mass[4 * index(slave) + s]) continue;
      const auto master = static_cast<std::ptrdiff_t>(4 * model_.nodes().master(slave));
      std::fill_n(moves_mass.begin() + master, 4, true);
    }
  }
  // and what follows moves the mass of its master, if none of its own
  for (int slave : slaves_) {
    if (moves_mass[4 * index(model_.nodes().master(slave))]) moves_mass[4 * index(slave)] = true;
  }
  double largest = 0.0;
  int place = -1;  // slot of the model
  const double length = model_.length();
  const auto compare = [&](int at) {
    const model::NodeSlots apart =
        model::NodeTable::slots(fitted, at) - model::NodeTable::slots(state.velocity, at);
    for (int s = 0; s < 4; ++s) {
      const double moved = speed_of(s, apart.col(s), length);
      if (!moves_mass[index(4 * at + s)] || moved <= largest) continue;
      largest = moved;
      place = 4 * at + s;
    }
  };
  each_unknown([&](const Layout::LocalBlock&, const model::Block& block) {
    if (!model_.nodes().is_slave(block.owner)) compare(block.owner);
  });
  for (std::size_t i = 0; i < given.size(); ++i) {
    const int slave = slaves_[i];
    model::NodeTable::slots(state.velocity, slave) = given[i];
    // where its master is known
    const bool is_here = layout_.owners()[index(unknowns.node_block(slave))] == comm_.rank();
    if (is_here && !given[i].isZero(0.0)) compare(slave);
  }
  forget_reactions();
  const auto [most, slot] = find_largest(largest, place);
  const int equation = largest_equation(b, negligible * multiplier_scale_ * most);
  if (slot < 0) return {most, false, -1, equation};
  return {most, slot % 4 != 0, slot / 4, equation};
}

}  // namespace culm::assembly
