#include <culm/assembly/system.hpp>
#include <culm/base/error.hpp>
#include <culm/model/reaction_source.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace culm::assembly {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

std::size_t global_index(const Map& map, std::size_t row) {
  return static_cast<std::size_t>(map.getGlobalElement(static_cast<int>(row)));
}

// What a sum over ranks adds to a value without changing it: x + -0 is x also where x is a zero.
constexpr double nothing = -0.0;

long long entries_of(const model::Batch& batch, const model::UnknownTable& unknowns) {
  if (!batch.has_tangent()) return 0;
  long long entries = 0;
  for (int item = 0; item < batch.size(); ++item) {
    long long width = 0;
    for (int b : batch.blocks(item, unknowns)) width += unknowns.block(b).shape.active;
    entries += width * width;
  }
  return entries;
}

long long multipliers_of(const model::Batch& batch, const model::UnknownTable& unknowns) {
  long long count = 0;
  for (int item = 0; item < batch.size(); ++item) {
    for (int b : batch.blocks(item, unknowns)) {
      if (unknowns.block(b).kind == model::BlockKind::multipliers) {
        count += unknowns.block(b).shape.active;
      }
    }
  }
  return count;
}

// Unknowns of a block as kernels write them, zero where supports took them away.
std::array<double, 12> unknowns_of(const model::BlockShape& shape, int first_column,
                                   std::span<const double> values, double factor) {
  std::array<double, 12> u{};
  for (int i = 0; i < shape.width; ++i) {
    const int at = shape.position[index(i)];
    if (at >= 0) u[index(i)] = factor * values[index(first_column + at)];
  }
  return u;
}

// P u: how the slots of the node of a block move with its unknowns, to first order.
model::NodeSlots slot_motion(const model::Model& model, int node, const std::array<double, 12>& u,
                             const model::Coordinates& q) {
  if (model.unknowns().form() == model::Form::multipliers) {
    return Eigen::Map<const model::NodeSlots>(u.data());
  }
  return model.nodes().slot_motion(node, Eigen::Map<const Vec6>(u.data()), q);
}

// Rates of the six unknowns of a node at the start of the step.
Vec6 velocity_of(const model::NodeTable& nodes, const model::State& state, int node) {
  return nodes.unknown_motion(node, model::NodeTable::slots(state.velocity, node), state.prev);
}

}  // namespace

System::System(model::Model& model, const parallel::Comm& comm, Ledger& ledger)
    : model_(model),
      comm_(comm),
      ledger_(ledger),
      layout_(model, comm),
      batches_(model.batches()),
      update_effect_(ledger.add("Update of the state")) {
  const model::UnknownTable& unknowns = model.unknowns();
  for (const model::Batch* batch : batches_) {
    Ledger::Entry entry;
    entry.name = batch->effect();
    entry.items = batch->size();
    const long long multipliers = multipliers_of(*batch, unknowns);
    if (multipliers > 0) entry.unknowns = multipliers;
    if (batch->has_tangent()) entry.entries_per_iteration = entries_of(*batch, unknowns);
    effects_.push_back(ledger.add(entry));
  }
  for (const auto& batch : model.constraint_batches()) driven_.push_back(batch.get());
  for (const auto& batch : model.loads()) driven_.push_back(batch.get());
  for (int node = 0; node < model.nodes().size(); ++node) {
    if (model.nodes().is_slave(node)) slaves_.push_back(node);
  }
  matrix_ = Teuchos::rcp(new CrsMatrix(layout_.graph()));
  matrix_->fillComplete(layout_.row_map(), layout_.row_map());
  matrix_view_ = matrix_;
  residual_ = Teuchos::rcp(new Vector(layout_.row_map()));
  if (comm_.size() > 1) {
    imported_ = Teuchos::rcp(new Vector(layout_.column_map()));
    importer_ = Teuchos::rcp(new Import(layout_.row_map(), layout_.column_map()));
  }
  const auto graph = matrix_->getLocalMatrixHost().graph;
  row_begin_.assign(graph.row_map.data(), graph.row_map.data() + graph.row_map.extent(0));
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    if (!local.owned) continue;
    const model::Block& block = unknowns.block(local.block);
    for (int i = 0; i < block.shape.active; ++i) {
      const auto row = index(local.first_column + i);  // owned columns are numbered as rows
      is_force_row_.push_back(block.kind == model::BlockKind::node);
      const auto first = graph.entries.data() + row_begin_[row];
      const auto last = graph.entries.data() + row_begin_[row + 1];
      diagonal_.push_back(static_cast<int>(
          row_begin_[row] +
          static_cast<std::size_t>(std::find(first, last, static_cast<int>(row)) - first)));
    }
  }
  length_ = model.length();
  velocity_dissipation_ = model::VelocityDissipation::find(model);
  reactions_.assign(index(unknowns.num_reactions()), 0.0);
  linear_increment_.assign(model.nodes().reference().size(), 0.0);
}

void System::begin_step(const model::State& state, const Stencil& stencil) {
  // coordinates are rounded to epsilon times their size, which grows as a model flies off
  size_ = length_;
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block& block = model_.unknowns().block(local.block);
    if (block.kind != model::BlockKind::node) continue;
    const auto slots = model::NodeTable::slots(state.prev, block.owner);
    size_ = std::max(size_, slots.col(0).lpNorm<Eigen::Infinity>());
  }
  size_ = comm_.max(size_);
  for (model::Batch* batch : batches_) batch->begin_step(state, stencil);
}

void System::change_level(const model::State& state, const Stencil& stencil) {
  for (model::Batch* batch : driven_) batch->begin_step(state, stencil);
}

void System::level_gradient(model::State& state, const Stencil& stencil, double step,
                            Vector& gradient) {
  model::Target target;
  target.row_begin = row_begin_;
  target.multiplier_scale = multiplier_scale_;
  target.residual = values_of(gradient);
  gradient.putScalar(0.0);
  const double level = state.time;
  for (const double end : {level, level + step}) {
    state.time = end;
    gradient.scale(-1.0);
    for (model::Batch* batch : driven_) {
      batch->begin_step(state, stencil);
      batch->assemble(state, stencil, Want::residual, target);
    }
  }
  gradient.scale(1.0 / step);
  state.time = level;
  change_level(state, stencil);
}

Evaluation System::evaluate(const model::State& state, const Stencil& stencil, Want want) {
  model::Target target;
  target.residual = values_of(*residual_);
  target.reactions = reactions_;
  target.row_begin = row_begin_;
  target.multiplier_scale = multiplier_scale_;
  std::fill(target.residual.begin(), target.residual.end(), 0.0);
  std::fill(reactions_.begin(), reactions_.end(), 0.0);
  if (want != Want::residual) {
    const auto values = matrix_->getLocalMatrixHost().values;
    target.values = {values.data(), values.extent(0)};
    std::fill(target.values.begin(), target.values.end(), 0.0);
  }
  Verdict verdict = Verdict::ok;
  std::optional<Ledger::Scope> scope;
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    if (scope) {
      scope->pass_to(effects_[b]);
    } else {
      scope.emplace(ledger_, effects_[b]);
    }
    verdict = worse(verdict, batches_[b]->assemble(state, stencil, want, target));
  }
  scope.reset();
  if (stencil.inertia != 0.0 && carried_) {
    for (std::size_t row = 0; row < carried_->size(); ++row) {
      target.residual[row] += (*carried_)[row] / stencil.step;
    }
  }
  double largest = 0.0;
  for (std::size_t row = 0; row < is_force_row_.size(); ++row) {
    if (is_force_row_[row]) largest = std::max(largest, std::abs(target.residual[row]));
  }
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * size_;
  if (want == Want::residual_and_tangent) stiffness_ = largest_diagonal();
  double found[5] = {static_cast<double>(verdict), largest, target.force_scale,
                     target.constraint_violation, rounding * stiffness_};
  comm_.max(found);
  return {static_cast<Verdict>(static_cast<int>(found[0])), found[1], found[2], found[3], found[4]};
}

void System::carry_residual(double time) {
  const auto residual = values_of(static_cast<const Vector&>(*residual_));
  carried_.emplace(residual.size(), 0.0);
  for (std::size_t row = 0; row < residual.size(); ++row) {
    if (is_force_row_[row]) (*carried_)[row] = time * residual[row];
  }
}

double System::largest_diagonal() const {
  const auto values = matrix_->getLocalMatrixHost().values;
  double largest = 0.0;
  for (std::size_t row = 0; row < diagonal_.size(); ++row) {
    if (is_force_row_[row]) largest = std::max(largest, std::abs(values(index(diagonal_[row]))));
  }
  return largest;
}

const Vector& System::import(const Vector& increment) {
  if (comm_.size() == 1) return increment;
  imported_->doImport(increment, *importer_, Tpetra::INSERT);
  return *imported_;
}

void System::move(model::State& state, const Vector& increment, double factor) {
  const Ledger::Scope scope(ledger_, update_effect_);
  const std::span<const double> dx = values_of(import(increment));
  const model::UnknownTable& unknowns = model_.unknowns();
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block& block = unknowns.block(local.block);
    if (block.shape.active == 0) continue;
    const auto u = unknowns_of(block.shape, local.first_column, dx, factor);
    if (block.kind == model::BlockKind::multipliers) {
      for (int i = 0; i < block.shape.width; ++i) {
        state.multipliers[index(block.first_multiplier + i)] += multiplier_scale_ * u[index(i)];
      }
    } else if (unknowns.form() == model::Form::null_space) {
      model_.nodes().move(block.owner, Eigen::Map<const Vec6>(u.data()), state.next);
    } else {
      model::NodeTable::slots(state.next, block.owner) +=
          Eigen::Map<const model::NodeSlots>(u.data());
    }
  }
  for (int slave : slaves_) model_.nodes().follow_master(slave, state.next);
  if (velocity_dissipation_ != nullptr) complete(state.next);
}

const model::Coordinates& System::linear_motion(const model::State& state, const Vector& increment,
                                                double factor) {
  const std::span<const double> dx = values_of(import(increment));
  const model::UnknownTable& unknowns = model_.unknowns();
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block& block = unknowns.block(local.block);
    if (block.kind != model::BlockKind::node) continue;
    const auto u = unknowns_of(block.shape, local.first_column, dx, factor);
    model::NodeTable::slots(linear_increment_, block.owner) =
        slot_motion(model_, block.owner, u, state.next);
  }
  // an eliminated node is linear in its master, so its increment follows in the same way
  for (int slave : slaves_) model_.nodes().follow_master(slave, linear_increment_);
  return linear_increment_;
}

void System::extrapolate(const model::State& state, const Stencil& stencil, const Vector& increment,
                         double factor) {
  const model::Coordinates& motion = linear_motion(state, increment, factor);
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    const Ledger::Scope scope(ledger_, effects_[b]);
    batches_[b]->extrapolate(state, stencil, motion);
  }
}

void System::complete(model::Coordinates& values) const {
  if (comm_.size() == 1 || values.empty()) return;
  const model::UnknownTable& unknowns = model_.unknowns();
  for (int node = 0; node < model_.nodes().size(); ++node) {
    if (layout_.owners()[index(unknowns.node_block(node))] == comm_.rank()) continue;
    model::NodeTable::slots(values, node).setConstant(nothing);
  }
  comm_.sum(values);
}

void System::synchronise(model::State& state) {
  gathered_reactions_ = reactions_;
  if (comm_.size() == 1) return;
  complete(state.next);
  complete(state.velocity);
  const model::UnknownTable& unknowns = model_.unknowns();
  for (int b = 0; b < static_cast<int>(unknowns.blocks().size()); ++b) {
    const model::Block& block = unknowns.block(b);
    if (block.kind != model::BlockKind::multipliers) continue;
    if (layout_.owners()[index(b)] == comm_.rank()) continue;
    std::fill_n(state.multipliers.begin() + block.first_multiplier, block.shape.width, nothing);
  }
  comm_.sum(state.multipliers);
  comm_.sum(gathered_reactions_);
}

void System::save(model::State& state, Snapshot& snapshot) {
  synchronise(state);
  snapshot.set("state/time", state.time);
  snapshot.set("state/position", state.next);
  snapshot.set("state/velocity", state.velocity);
  snapshot.set("state/multipliers", state.multipliers);
  snapshot.set("state/at rest", state.at_rest ? 1.0 : 0.0);
  snapshot.set("system/multiplier scale", multiplier_scale_);
  snapshot.set("system/carried", gather_carried());
  std::vector<double> memory;
  for (const model::Batch* batch : batches_) {
    std::vector<double> part(batch->memory_size(), nothing);
    batch->save(part);
    memory.insert(memory.end(), part.begin(), part.end());
  }
  comm_.sum(memory);
  snapshot.set("system/batches", std::move(memory));
}

void System::restore(const Snapshot& snapshot, model::State& state) {
  state.time = state.time_prev = snapshot.number("state/time");
  state.next = state.prev = snapshot.numbers("state/position", state.next.size());
  state.velocity = snapshot.numbers("state/velocity");
  state.acceleration_offset.assign(state.velocity.size(), 0.0);
  state.multipliers = snapshot.numbers("state/multipliers", state.multipliers.size());
  state.multipliers_prev = state.multipliers;
  state.at_rest = snapshot.number("state/at rest") != 0.0;
  multiplier_scale_ = snapshot.number("system/multiplier scale");
  restore_carried(snapshot.numbers("system/carried"));
  std::size_t size = 0;
  for (const model::Batch* batch : batches_) size += batch->memory_size();
  std::span<const double> memory = snapshot.numbers("system/batches", size);
  for (model::Batch* batch : batches_) {
    batch->restore(memory.first(batch->memory_size()));
    memory = memory.subspan(batch->memory_size());
  }
}

// By global row, so that it does not depend on the number of ranks.
std::vector<double> System::gather_carried() const {
  if (!carried_) return {};
  std::vector<double> all(layout_.row_map()->getGlobalNumElements(), nothing);
  for (std::size_t row = 0; row < carried_->size(); ++row) {
    all[global_index(*layout_.row_map(), row)] = (*carried_)[row];
  }
  comm_.sum(all);
  return all;
}

void System::restore_carried(const std::vector<double>& all) {
  carried_.reset();
  if (all.empty()) return;
  carried_.emplace(is_force_row_.size());
  for (std::size_t row = 0; row < carried_->size(); ++row) {
    (*carried_)[row] = all[global_index(*layout_.row_map(), row)];
  }
}

void System::save_matrix(Snapshot& snapshot) const {
  const auto values = matrix_->getLocalMatrixHost().values;
  const std::vector<double> all =
      comm_.gather(std::span<const double>(values.data(), values.extent(0)));
  snapshot.set("matrix/ranks", comm_.size());
  snapshot.set("matrix/values", all);
}

bool System::restore_matrix(const Snapshot& snapshot) {
  if (snapshot.integer("matrix/ranks") != comm_.size()) return false;
  const auto values = matrix_->getLocalMatrixHost().values;
  const std::vector<double>& all =
      snapshot.numbers("matrix/values", static_cast<std::size_t>(matrix_->getGlobalNumEntries()));
  // pieces are in the order of the ranks
  std::vector<double> ends(index(comm_.size()), 0.0);
  for (int rank = comm_.rank(); rank < comm_.size(); ++rank) {
    ends[index(rank)] = static_cast<double>(values.extent(0));
  }
  comm_.sum(ends);
  const auto begin = index(static_cast<int>(ends[index(comm_.rank())])) - values.extent(0);
  std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(begin), values.extent(0), values.data());
  return true;
}

void System::choose_multiplier_scale(const model::State& state, const Stencil& stencil) {
  multiplier_scale_ = 1.0;
  if (model_.unknowns().num_multipliers() == 0) return;
  evaluate(state, stencil, Want::residual_and_tangent);
  const double largest = comm_.max(largest_diagonal());
  // a power of two scales without rounding; the root lies between the force and the unit rows
  if (largest > 0.0) multiplier_scale_ = std::exp2(std::round(std::log2(largest)));
}

Vec6 System::reaction(int node, const model::State& state) const {
  const model::UnknownTable& unknowns = model_.unknowns();
  const model::BlockShape& shape = unknowns.block(unknowns.node_block(node)).shape;
  Vec6 reaction = Vec6::Zero();
  if (unknowns.form() == model::Form::null_space) {
    for (int i = 0; i < 6; ++i) {
      const int at = shape.position[index(i)];
      if (at < 0) reaction[i] = gathered_reactions_[index(shape.first_reaction - 1 - at)];
    }
  }
  return reaction + equation_reaction("", node, state);
}

Vec6 System::reaction_of(const std::string& constraint, int node, const model::State& state) const {
  return equation_reaction(constraint, node, state);
}

Vec6 System::equation_reaction(const std::string& constraint, int node,
                               const model::State& state) const {
  Vec6 reaction = Vec6::Zero();
  for (const auto& batch : model_.constraint_batches()) {
    reaction += batch->reaction(node, state, constraint);
  }
  for (const auto& load : model_.loads()) {
    if (const auto* source = dynamic_cast<const model::ReactionSource*>(load.get())) {
      reaction += source->reaction(node, state, constraint);
    }
  }
  return reaction;
}

double System::project_position(model::State& state, const Solve& solve_mass) {
  const model::Coordinates start = state.next;
  const Stencil stencil = Stencil::statics();
  begin_step(state, stencil);
  constexpr int most_iterations = 50;
  for (int iteration = 0;; ++iteration) {
    const Evaluation found = evaluate(state, stencil, Want::residual);
    if (found.constraint_violation <= 1e-14) break;
    if (iteration == most_iterations || !std::isfinite(found.constraint_violation)) {
      return std::numeric_limits<double>::infinity();
    }
    Vector rhs(*residual_, Teuchos::Copy);
    evaluate(state, stencil, Want::mass);
    const auto b = values_of(rhs);
    for (std::size_t row = 0; row < b.size(); ++row) b[row] = is_force_row_[row] ? 0.0 : -b[row];
    Vector change(layout_.row_map());
    solve_mass(rhs, change);
    const auto u = values_of(change);
    for (std::size_t row = 0; row < u.size(); ++row) {
      if (!is_force_row_[row]) u[row] = 0.0;  // its multipliers are no forces
    }
    const bool stalls = comm_.max(change.normInf()) < 1e-15 * size_;
    move(state, change, 1.0);
    if (stalls) break;  // at round-off
  }
  double largest = 0.0;
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block& block = model_.unknowns().block(local.block);
    if (block.kind != model::BlockKind::node) continue;
    const auto change = model::NodeTable::slots(state.next, block.owner) -
                        model::NodeTable::slots(start, block.owner);
    largest = std::max(largest, change.cwiseAbs().maxCoeff());
  }
  state.prev = state.next;
  return comm_.max(largest);
}

// Calls action(node, shape) for nodes here that have unknowns of their own.
template <class Action>
void System::each_moving_node(Action action) const {
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block& block = model_.unknowns().block(local.block);
    if (block.kind == model::BlockKind::node && block.shape.active > 0) {
      action(block.owner, block.shape);
    }
  }
}

System::Motions System::motions(const model::State& state) const {
  Motions motions(index(model_.nodes().size()), Vec6::Zero());
  each_moving_node([&](int node, const model::BlockShape&) {
    motions[index(node)] = model_.nodes().motion(node, state.prev, state.next);
  });
  return motions;
}

System::Motions System::velocities(const model::State& state) const {
  Motions velocities(index(model_.nodes().size()), Vec6::Zero());
  each_moving_node([&](int node, const model::BlockShape&) {
    velocities[index(node)] = velocity_of(model_.nodes(), state, node);
  });
  return velocities;
}

void System::move_nodes(model::State& state, const Motions& motions) const {
  each_moving_node([&](int node, const model::BlockShape& shape) {
    Vec6 u = motions[index(node)];
    for (int i = 0; i < 6 && shape.width == 6; ++i) {
      if (shape.position[index(i)] < 0) u[i] = 0.0;
    }
    model_.nodes().move(node, u, state.next);
  });
  for (int slave : slaves_) model_.nodes().follow_master(slave, state.next);
  if (velocity_dissipation_ != nullptr) complete(state.next);
}

std::vector<double> System::gather_motions(const Motions& motions) const {
  std::vector<double> numbers;
  for (int node = 0; node < model_.nodes().size(); ++node) {
    const bool mine = layout_.owners()[index(model_.unknowns().node_block(node))] == comm_.rank();
    for (int i = 0; i < 6; ++i) numbers.push_back(mine ? motions[index(node)][i] : nothing);
  }
  comm_.sum(numbers);
  return numbers;
}

System::Motions System::spread_motions(const std::vector<double>& numbers) const {
  Motions motions(index(model_.nodes().size()), Vec6::Zero());
  each_moving_node([&](int node, const model::BlockShape&) {
    motions[index(node)] = Eigen::Map<const Vec6>(numbers.data() + 6 * node);
  });
  return motions;
}

// dg/dt of all constraint rows at state.time: h = h_q - g, so g is what h loses while q stays.
// Second-order differences; zero without work when nothing is driven.
std::vector<double> System::drive_speed(model::State& state, double probe) {
  std::vector<double> speed(is_force_row_.size(), 0.0);
  const auto& equations = model_.equations();
  if (std::none_of(equations.begin(), equations.end(),
                   [](const model::Constraint& c) { return static_cast<bool>(c.drive); })) {
    return speed;
  }
  const double time = state.time;
  for (const auto& [fraction, weight] : {std::pair{1.0, 1.0}, {0.5, -4.0}, {0.0, 3.0}}) {
    state.time = time + fraction * probe;
    begin_step(state, Stencil::statics());
    evaluate(state, Stencil::statics(), Want::residual);
    const auto h = values_of(static_cast<const Vector&>(*residual_));
    for (std::size_t row = 0; row < speed.size(); ++row) speed[row] += weight / probe * h[row];
  }
  return speed;
}

double System::project_velocity(model::State& state, double probe, const Solve& solve_mass) {
  // velocities given to eliminated nodes are those of their masters
  for (int slave : slaves_) model_.nodes().follow_master(slave, state.velocity);
  const std::vector<double> speed = drive_speed(state, probe);
  const Evaluation found = evaluate(state, Stencil::statics(), Want::mass);
  internal_check(found.verdict == Verdict::ok, "a mass matrix is not finite");
  const model::UnknownTable& unknowns = model_.unknowns();
  const bool null_space = unknowns.form() == model::Form::null_space;
  Vector velocity(layout_.row_map());
  const auto u = values_of(velocity);
  const auto each_unknown = [&](auto action) {
    for (const Layout::LocalBlock& local : layout_.local_blocks()) {
      const model::Block& block = unknowns.block(local.block);
      if (block.kind != model::BlockKind::node) continue;
      action(local, block);
    }
  };
  each_unknown([&](const Layout::LocalBlock& local, const model::Block& block) {
    if (!local.owned) return;
    const Vec6 rigid = velocity_of(model_.nodes(), state, block.owner);
    const auto slots = model::NodeTable::slots(state.velocity, block.owner);
    for (int i = 0; i < block.shape.width; ++i) {
      const int at = block.shape.position[index(i)];
      if (at >= 0) u[index(local.first_column + at)] = null_space ? rigid[i] : slots.data()[i];
    }
  });
  // only the constraint rows are out of balance: H v = dg/dt
  Vector rhs(layout_.row_map());
  matrix_->apply(velocity, rhs);
  const auto b = values_of(rhs);
  for (std::size_t row = 0; row < b.size(); ++row)
    b[row] = is_force_row_[row] ? 0.0 : speed[row] - b[row];
  Vector change(layout_.row_map());
  solve_mass(rhs, change);
  velocity.update(1.0, change, 1.0);

  const model::Coordinates before = state.velocity;
  const std::span<const double> all = values_of(import(velocity));
  std::fill(state.velocity.begin(), state.velocity.end(), 0.0);
  each_unknown([&](const Layout::LocalBlock& local, const model::Block& block) {
    const auto w = unknowns_of(block.shape, local.first_column, all, 1.0);
    model::NodeTable::slots(state.velocity, block.owner) =
        slot_motion(model_, block.owner, w, state.next);
  });
  for (int slave : slaves_) model_.nodes().follow_master(slave, state.velocity);
  if (velocity_dissipation_ != nullptr) complete(state.velocity);
  double largest = 0.0;
  each_unknown([&](const Layout::LocalBlock&, const model::Block& block) {
    if (model_.nodes().is_slave(block.owner)) return;  // its master may be elsewhere
    const auto first = static_cast<std::size_t>(model::NodeTable::offset(block.owner));
    for (std::size_t i = first; i < first + 12; ++i) {
      largest = std::max(largest, std::abs(state.velocity[i] - before[i]));
    }
  });
  return comm_.max(largest);
}

double System::strain_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (const auto& batch : model_.element_batches()) energy += batch->stored_energy(q);
  return comm_.sum(energy);
}

Energies System::energies(const model::Coordinates& q, const model::Momentum& momentum) const {
  Energies energies;
  energies.kinetic = momentum.kinetic_energy;
  energies.strain = strain_energy(q);
  for (const auto& load : model_.loads()) energies.potential += load->stored_energy(q);
  energies.potential = comm_.sum(energies.potential);
  return energies;
}

model::Momentum System::momentum(const model::Coordinates& q,
                                 const model::Coordinates& velocity) const {
  model::Momentum total;
  for (const auto& batch : model_.element_batches()) {
    if (const auto* source = dynamic_cast<const model::MassSource*>(batch.get())) {
      source->add_momentum(q, velocity, total);
    }
  }
  total.kinetic_energy = comm_.sum(total.kinetic_energy);
  comm_.sum(std::span(total.linear.data(), 3));
  comm_.sum(std::span(total.angular.data(), 3));
  return total;
}

model::StepWork System::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork total;
  for (const model::Batch* batch : batches_) total += batch->step_work(state, stencil);
  double scalars[4] = {total.external, total.drives, total.damping, total.dissipation};
  comm_.sum(scalars);
  total.external = scalars[0];
  total.drives = scalars[1];
  total.damping = scalars[2];
  total.dissipation = scalars[3];
  comm_.sum(std::span(total.force.data(), 3));
  comm_.sum(std::span(total.moment.data(), 3));
  return total;
}

}  // namespace culm::assembly
