#include <culm/assembly/ghost_import.hpp>
#include <culm/assembly/system.hpp>
#include <culm/model/delayed.hpp>
#include <culm/parallel/shared_failure.hpp>

#include "block_values.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace culm::assembly {
namespace {

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

long long unknowns_beside_nodes(const model::Batch& batch, const model::UnknownTable& unknowns) {
  long long count = 0;
  for (int item = 0; item < batch.size(); ++item) {
    for (int b : batch.blocks(item, unknowns)) {
      if (unknowns.block(b).kind != model::BlockKind::node) {
        count += unknowns.block(b).shape.active;
      }
    }
  }
  return count;
}

}  // namespace

System::System(model::Model& model, const parallel::Comm& comm, Ledger& ledger)
    : model_(model),
      comm_(comm),
      ledger_(ledger),
      layout_(model, comm),
      batches_(model.batches()),
      update_effect_(ledger.add("Update of the state")),
      matrix_(std::make_shared<Matrix>(layout_.pattern())),
      matrix_view_(matrix_),
      first_columns_(assembly::first_columns(matrix_->row_begin(), matrix_->column_of())),
      residual_(layout_.rows()) {
  const model::UnknownTable& unknowns = model.unknowns();
  std::vector<Ledger::Id> effects;
  for (const model::Batch* batch : batches_) {
    Ledger::Entry entry;
    entry.name = batch->effect().title();
    entry.items = batch->size();
    const long long others = unknowns_beside_nodes(*batch, unknowns);
    if (others > 0) entry.unknowns = others;
    if (batch->has_tangent()) entry.entries_per_iteration = entries_of(*batch, unknowns);
    effects.push_back(ledger.add(entry));
  }
  for (std::optional<Ledger::Round>& round : evaluations_) round.emplace(ledger, effects);
  extrapolation_.emplace(ledger, effects);
  for (const auto& batch : model.element_batches()) {
    const auto* source = dynamic_cast<const model::MassSource*>(batch.get());
    if (source != nullptr) masses_.push_back(source);
    if (batch->depends_on_time()) driven_.push_back(batch.get());
  }
  driven_elements_ = driven_.size();
  for (const auto& batch : model.constraint_batches()) driven_.push_back(batch.get());
  for (const auto& batch : model.loads()) {
    driven_.push_back(batch.get());
    const auto* source = dynamic_cast<const model::ReactionSource*>(batch.get());
    if (source != nullptr) reaction_sources_.push_back(source);
  }
  find_needed_nodes();
  for (int node = 0; node < model.nodes().size(); ++node) {
    if (layout_.owners()[index(unknowns.node_block(node))] == comm_.rank()) {
      owned_nodes_.push_back(node);
    }
  }
  if (comm_.size() > 1) {
    ghosts_ = std::make_unique<GhostImport>(layout_.rows(), layout_.columns());
  }
  const auto row_begin = matrix_->row_begin();
  const auto column_of = matrix_->column_of();
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    if (!local.owned) continue;
    const model::Block block = unknowns.block(local.block);
    for (int i = 0; i < block.shape.active; ++i) {
      const auto row = index(local.first_column + i);  // owned columns are numbered as rows
      const auto of_row = column_of.subspan(row_begin[row], row_begin[row + 1] - row_begin[row]);
      const auto found = std::ranges::find(of_row, static_cast<int>(row)) - of_row.begin();
      diagonal_.push_back(row_begin[row] + static_cast<std::size_t>(found));
    }
  }
  for (const model::Batch* batch : batches_) needs_all_nodes_ |= batch->needs_all_nodes();
  reactions_.assign(index(unknowns.num_reactions()), 0.0);
  linear_increment_.assign(model.nodes().reference().size(), 0.0);
}

System::~System() = default;

// Nodes that rows of this rank depend on, and the eliminated ones among them.
void System::find_needed_nodes() {
  const model::UnknownTable& unknowns = model_.unknowns();
  std::vector<bool> is_local(index(unknowns.num_blocks()), false);
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    is_local[index(local.block)] = true;
    const model::Block block = unknowns.block(local.block);
    const bool moves = block.kind == model::BlockKind::node && block.shape.active > 0;
    if (!moves) continue;
    moving_nodes_.push_back(block.owner);
    if (local.owned) ++num_own_motions_;
  }
  for (int node = 0; node < model_.nodes().size(); ++node) {
    is_needed_.push_back(is_local[index(unknowns.node_block(node))]);
    if (is_needed_.back() && model_.nodes().is_slave(node)) slaves_.push_back(node);
  }
}

void System::forget_others(model::State& state) const {
  if (needs_all_nodes_) return;
  const auto begin_of = [](auto place, const std::vector<bool>& all) {
    return static_cast<std::size_t>(
        model::NodeTable::offset(static_cast<int>(place - all.begin())));
  };
  for (model::Coordinates* values :
       {&state.prev, &state.next, &state.velocity, &state.acceleration_offset}) {
    if (values->empty()) continue;
    // runs of nodes that are not needed
    for (auto first = is_needed_.begin(); first != is_needed_.end();) {
      first = std::find(first, is_needed_.end(), false);
      const auto last = std::find(first, is_needed_.end(), true);
      values->release(begin_of(first, is_needed_), begin_of(last, is_needed_));
      first = last;
    }
  }
}

void System::forget_other_items() {
  if (needs_all_nodes_) return;
  for (model::Batch* batch : batches_) batch->forget_others();
}

void System::prepare(const model::State& state, const Stencil& stencil) {
  parallel::together(comm_, [&] {
    for (model::Batch* batch : batches_) batch->prepare(state, stencil);
  });
}

void System::forget_evaluation() {
  forget_reactions();
  for (model::Batch* batch : batches_) batch->forget_evaluation();
}

// The evaluation is made once more, so that batches know of the attempt what accept() needs.
void System::preview(const model::State& state, const model::Coordinates& velocity,
                     const Stencil& stencil, const std::function<void(model::State&)>& look) {
  const std::vector<double> before = memory(model::Items::local);
  const std::vector<double> reactions = reactions_;
  model::State ahead = state;
  ahead.velocity = velocity;
  parallel::together(comm_, [&] {
    for (model::Batch* batch : batches_) {
      if (batch->can_go_back()) batch->accept(ahead);
    }
  });
  const auto go_back = [&] {
    restore_memory(before);
    prepare(state, stencil);
    evaluate(state, stencil, Want::residual);
    reactions_ = reactions;
  };
  try {
    look(ahead);
  } catch (...) {
    go_back();
    throw;
  }
  go_back();
}

void System::accept(model::State& state) {
  if (carries_residuals_) carry_residual(state.time - state.time_prev);
  parallel::together(comm_, [&] {
    for (model::Batch* batch : batches_) batch->accept(state);
  });
  state.prev = state.next;
  state.multipliers_prev = state.multipliers;
  state.own_prev = state.own;
  state.time_prev = state.time;
}

void System::discard(model::State& state) const {
  state.next = state.prev;
  state.multipliers = state.multipliers_prev;
  state.own = state.own_prev;
  state.time = state.time_prev;
}

void System::carry_residuals(bool wanted) {
  carries_residuals_ = wanted;
  if (!wanted) carried_.reset();
  held_share_ = 0.0;
}

void System::change_level(const model::State& state, const Stencil& stencil) {
  parallel::together(comm_, [&] {
    for (model::Batch* batch : driven_) batch->prepare(state, stencil);
  });
}

void System::show_level(const model::State& state) {
  for (std::size_t i = 0; i < driven_elements_; ++i) driven_[i]->prepare(state, {});
}

void System::level_gradient(model::State& state, const Stencil& stencil, double step,
                            Vector& gradient) {
  model::Target target;
  target.row_begin = matrix_->row_begin();
  target.multiplier_scale = multiplier_scale_;
  target.residual = gradient.values();
  gradient.fill(0.0);
  const double level = state.time;
  for (const double end : {level, level + step}) {
    state.time = end;
    gradient.scale(-1.0);
    parallel::together(comm_, [&] {
      for (model::Batch* batch : driven_) {
        batch->prepare(state, stencil);
        batch->assemble(state, stencil, Want::residual, target);
      }
    });
  }
  gradient.scale(1.0 / step);
  state.time = level;
  change_level(state, stencil);
}

// Residual and reactions, set to zero.
model::Target System::target() {
  model::Target target;
  target.residual = residual_.values();
  target.reactions = reactions_;
  target.row_begin = matrix_->row_begin();
  target.multiplier_scale = multiplier_scale_;
  std::fill(target.residual.begin(), target.residual.end(), 0.0);
  std::fill(reactions_.begin(), reactions_.end(), 0.0);
  return target;
}

model::Target System::target_with_matrix() {
  model::Target with_matrix = target();
  with_matrix.values = matrix_->values();
  std::fill(with_matrix.values.begin(), with_matrix.values.end(), 0.0);
  return with_matrix;
}

std::vector<double> System::relaxation_times() const {
  std::set<double> all;
  for (const model::Batch* batch : batches_) {
    const std::vector<double> times = batch->relaxation_times();
    all.insert(times.begin(), times.end());
  }
  return {all.begin(), all.end()};
}

Verdict System::evaluate_branches(const model::State& state, double time) {
  model::Target target = target_with_matrix();
  Verdict verdict = Verdict::ok;
  for (model::Batch* batch : batches_) {
    verdict = worse(verdict, batch->assemble_branches(state, time, target));
  }
  return static_cast<Verdict>(static_cast<int>(comm_.max(static_cast<double>(verdict))));
}

std::vector<double> System::delays(const model::State& state) const {
  std::vector<double> all;
  for (const model::Batch* batch : batches_) {
    const auto* delayed = dynamic_cast<const model::Delayed*>(batch);
    if (delayed == nullptr) continue;
    const std::vector<double> some = delayed->delays(state);
    all.insert(all.end(), some.begin(), some.end());
  }
  all = comm_.gather(std::span<const double>(all));
  std::ranges::sort(all);
  const auto same = [](double a, double b) { return b - a <= model::same_delay * b; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  all.resize(static_cast<std::size_t>(comm_.max(static_cast<int>(all.size()))));
  comm_.broadcast(std::span<double>(all));
  return all;
}

Verdict System::evaluate_delayed(const model::State& state, const Stencil& stencil, double delay) {
  model::Target target = target_with_matrix();
  Verdict verdict = Verdict::ok;
  parallel::together(comm_, [&] {
    for (model::Batch* batch : batches_) {
      if (auto* delayed = dynamic_cast<model::Delayed*>(batch)) {
        verdict = worse(verdict, delayed->assemble_delayed(state, stencil, delay, target));
      }
    }
  });
  return static_cast<Verdict>(comm_.max(static_cast<int>(verdict)));
}

Evaluation System::evaluate(const model::State& state, const Stencil& stencil, Want want) {
  constexpr std::size_t worth_waiting = 65536;  // numbers; fewer stay in the cache
  model::Target target = this->target();
  if (want != Want::residual) {
    target.values = matrix_->values();
    target.stale_from = 0;
    if (target.values.size() < worth_waiting) target.clear_rest();
  }
  if (watches_tangents_ && want != Want::residual) tangent_point_ = state.next;
  Verdict verdict = Verdict::ok;
  parallel::SharedFailure failure;
  failure.watch([&] {
    Ledger::Round::Lap lap(*evaluations_[static_cast<std::size_t>(want)]);
    for (std::size_t b = 0; b < batches_.size(); ++b) {
      lap.pass_to(b);
      verdict = worse(verdict, batches_[b]->assemble(state, stencil, want, target));
    }
  });
  target.clear_rest();
  const double carried = stencil.inertia != 0.0 ? 1.0 / stencil.step : held_share_;
  if (carried_ && carried != 0.0) {
    for (std::size_t row = 0; row < carried_->size(); ++row) {
      target.residual[row] += carried * (*carried_)[row];
    }
  }
  const double largest = find_largest_force();
  // items are finite one by one, their sum may not be
  if (!std::isfinite(as_vector(target.residual).sum()))
    verdict = worse(verdict, Verdict::not_finite);
  double found[5] = {static_cast<double>(verdict), largest, target.force_scale,
                     target.constraint_violation, failure.is_here() ? 1.0 : 0.0};
  comm_.max(found);
  if (found[4] != 0.0) failure.throw_everywhere(comm_);
  return {static_cast<Verdict>(static_cast<int>(found[0])), found[1], found[2], found[3]};
}

// Of the residual on this rank; notes its row.
double System::find_largest_force() {
  constexpr std::size_t together = 128;
  const auto forces = std::as_const(residual_).values().first(index(num_force_rows()));
  double largest = 0.0;
  std::size_t from = 0;
  for (std::size_t first = 0; first < forces.size(); first += together) {
    const double size =
        largest_size(forces.subspan(first, std::min(together, forces.size() - first)));
    if (!(size > largest)) continue;  // nor where none is a number
    largest = size;
    from = first;
  }
  const auto is_largest = [&](double force) { return std::abs(force) == largest; };
  const auto found =
      std::find_if(forces.begin() + static_cast<std::ptrdiff_t>(from), forces.end(), is_largest);
  largest_force_row_ = largest > 0.0 ? static_cast<int>(found - forces.begin()) : -1;
  return largest;
}

Evaluation System::note_unbalance(const model::State& state, const Stencil& stencil) {
  carried_.reset();
  prepare(state, stencil);
  const Evaluation found = evaluate(state, stencil, Want::residual);
  carry_residual(-1.0);
  return found;
}

void System::carry_residual(double factor) {
  const auto residual = std::as_const(residual_).values();
  carried_.emplace(residual.size(), 0.0);
  for (std::size_t row = 0; row < index(num_force_rows()); ++row) {
    (*carried_)[row] = factor * residual[row];
  }
}

double System::largest_diagonal() const {
  const auto values = std::as_const(*matrix_).values();
  double largest = 0.0;
  for (std::size_t row = 0; row < index(num_force_rows()); ++row) {
    largest = std::max(largest, std::abs(values[diagonal_[row]]));
  }
  return largest;
}

void System::stiffen(double share) {
  const double largest = comm_.max(largest_diagonal());
  const double least = largest > 0.0 ? largest : 1.0;
  const auto values = matrix_->values();
  for (std::size_t row = 0; row < index(num_force_rows()); ++row) {
    double& entry = values[diagonal_[row]];
    entry += share * (entry == 0.0 ? least : std::abs(entry));
  }
}

// Valid as long as the increment and until the next call.
ColumnValues System::column_values(const Vector& increment) {
  return ghosts_ ? (*ghosts_)(increment) : ColumnValues{increment.values(), {}};
}

void System::move(model::State& state, const Vector& increment, double factor) {
  const Ledger::Scope scope(ledger_, update_effect_);
  const ColumnValues dx = column_values(increment);
  const model::UnknownTable& unknowns = model_.unknowns();
  std::optional<NodeMoves> moves(std::in_place, model_.nodes(), state.next);
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block block = unknowns.block(local.block);
    if (block.shape.active == 0) continue;
    const auto u = unknowns_of(block.shape, dx.from(local.first_column), factor);
    if (block.kind == model::BlockKind::multipliers) {
      for (int i = 0; i < block.shape.width; ++i) {
        state.multipliers[index(block.first_value + i)] += multiplier_scale_ * u[index(i)];
      }
    } else if (block.kind == model::BlockKind::own) {
      const auto& own = model_.own_blocks()[index(block.owner)].unknowns;
      for (int i = 0; i < block.shape.width; ++i) {
        state.own[index(block.first_value + i)] +=
            own_scale(own[index(i)], multiplier_scale_) * u[index(i)];
      }
    } else if (unknowns.form() == model::Form::null_space) {
      moves->add(block.owner, Eigen::Map<const Vec6>(u.data()));
    } else {
      model::NodeTable::slots(state.next, block.owner) +=
          Eigen::Map<const model::NodeSlots>(u.data());
    }
  }
  moves.reset();
  for (int slave : slaves_) model_.nodes().follow_master(slave, state.next);
  if (needs_all_nodes_) complete(state.next);
}

const model::Coordinates& System::linear_motion(const model::State& state, const Vector& increment,
                                                double factor) {
  const ColumnValues dx = column_values(increment);
  const model::UnknownTable& unknowns = model_.unknowns();
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    const model::Block block = unknowns.block(local.block);
    if (block.kind != model::BlockKind::node) continue;
    const auto u = unknowns_of(block.shape, dx.from(local.first_column), factor);
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
  Ledger::Round::Lap lap(*extrapolation_);
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    lap.pass_to(b);
    batches_[b]->extrapolate(state, stencil, motion);
  }
}

void System::choose_multiplier_scale(const model::State& state, const Stencil& stencil, Want want) {
  multiplier_scale_ = 1.0;
  if (model_.unknowns().num_forces() == 0) return;
  evaluate(state, stencil, want);
  const double largest = comm_.max(largest_diagonal());
  // a power of two scales without rounding; the root lies between the force and the unit rows
  if (largest > 0.0 && std::isfinite(largest))
    multiplier_scale_ = std::exp2(std::round(std::log2(largest)));
}

}  // namespace culm::assembly
