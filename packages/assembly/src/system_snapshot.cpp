#include <culm/assembly/system.hpp>
#include <culm/base/error.hpp>
#include <culm/parallel/shared_failure.hpp>

#include "block_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace culm::assembly {

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
  complete(state.next);
  complete(state.velocity);
  gather_forces(state);
}

model::State System::gather(const model::State& state) {
  model::State whole;
  whole.time_prev = state.time_prev;
  whole.time = state.time;
  whole.at_rest = state.at_rest;
  whole.in_motion = state.in_motion;
  whole.next = gather(state.next);
  whole.prev = whole.next;  // what is asked of it at its end reads the start, too, by no weight
  whole.velocity = gather(state.velocity);
  whole.multipliers = state.multipliers;
  whole.own = state.own;
  gather_forces(whole);
  return whole;
}

model::Coordinates System::gather(const model::Coordinates& values) const {
  if (comm_.size() == 1 || values.empty()) return values;
  if (!comm_.is_root()) {
    gather_nodes(own_slots(values), 12, {});
    return values;
  }
  model::Coordinates all(values.size());
  gather_nodes(own_slots(values), 12, all);
  return all;
}

// Numbers of all nodes, `of_node` each, into `all` on rank 0; given those of the nodes of this
// rank.
void System::gather_nodes(std::span<const double> own, std::size_t of_node,
                          std::span<double> all) const {
  std::vector<std::vector<int>> nodes_of(comm_.is_root() ? index(comm_.size()) : 0);
  if (comm_.is_root()) {
    const model::UnknownTable& unknowns = model_.unknowns();
    for (int node = 0; node < model_.nodes().size(); ++node) {
      nodes_of[index(layout_.owners()[index(unknowns.node_block(node))])].push_back(node);
    }
  }
  comm_.gather(own, [&](int rank, std::span<const double> piece) {
    const double* from = piece.data();
    for (const int node : nodes_of[index(rank)]) {
      std::copy_n(from, of_node, all.data() + of_node * index(node));
      from += of_node;
    }
  });
}

// Writes numbers of all nodes, given what finds those of the nodes of this rank.
void System::save_nodes(std::function<std::vector<double>()> find_own, std::size_t of_node,
                        std::string_view name, Snapshot& snapshot) const {
  const std::size_t nodes = index(model_.nodes().size());
  if (snapshot.is_shared()) {
    RowRanges rows;
    for (const int node : owned_nodes_) append_row(rows, index(node));
    snapshot.add_table({std::string(name), nodes, of_node, std::move(rows), std::move(find_own)});
    return;
  }
  std::vector<double> all(comm_.is_root() ? nodes * of_node : 0);
  gather_nodes(find_own(), of_node, all);
  snapshot.set(name, std::move(all));
}

std::vector<double> System::own_slots(const model::Coordinates& values) const {
  std::vector<double> own;
  own.reserve(12 * owned_nodes_.size());
  for (const int node : owned_nodes_) {
    const double* slots = values.data() + model::NodeTable::offset(node);
    own.insert(own.end(), slots, slots + 12);
  }
  return own;
}

// Multipliers, unknowns of batches and reactions of all ranks on all.
void System::gather_forces(model::State& state) {
  gathered_reactions_ = reactions_;
  if (comm_.size() == 1) return;
  const model::UnknownTable& unknowns = model_.unknowns();
  for (int b = 0; b < unknowns.num_blocks(); ++b) {
    const model::Block block = unknowns.block(b);
    if (block.kind == model::BlockKind::node) continue;
    if (layout_.owners()[index(b)] == comm_.rank()) continue;
    auto& values = block.kind == model::BlockKind::own ? state.own : state.multipliers;
    std::fill_n(values.begin() + block.first_value, block.shape.width, nothing);
  }
  comm_.sum(state.multipliers);
  comm_.sum(state.own);
  comm_.sum(gathered_reactions_);
}

void System::synchronise(model::State& state, std::span<const int> nodes) const {
  if (comm_.size() == 1 || nodes.empty()) return;
  const model::UnknownTable& unknowns = model_.unknowns();
  std::vector<double> values;
  const auto for_slots = [&](const auto& action) {
    for (model::Coordinates* all : {&state.next, &state.velocity}) {
      if (all->empty()) continue;
      for (int node : nodes) action(node, model::NodeTable::slots(*all, node));
    }
  };
  for_slots([&](int node, auto slots) {
    const bool owned = layout_.owners()[index(unknowns.node_block(node))] == comm_.rank();
    for (double value : slots.reshaped()) values.push_back(owned ? value : nothing);
  });
  comm_.sum(values);
  auto from = values.begin();
  for_slots([&](int, auto slots) {
    for (double& value : slots.reshaped()) value = *from++;
  });
}

void System::save(const model::Coordinates& values, std::string_view name,
                  Snapshot& snapshot) const {
  const bool is_whole = comm_.size() == 1 && !snapshot.is_shared();
  if (snapshot.is_for_memory() || is_whole || values.empty()) {
    snapshot.set(name, values);
  } else {
    save_nodes([this, &values] { return own_slots(values); }, 12, name, snapshot);
  }
}

void System::restore(const Snapshot& snapshot, std::string_view name,
                     model::Coordinates& values) const {
  if (snapshot.is_for_memory() || comm_.size() == 1) {
    values.assign(snapshot.numbers(name));
    return;
  }
  const auto found = snapshot.numbers(name);
  std::vector<double> all(index(comm_.max(static_cast<int>(found.size()))));
  if (comm_.is_root()) std::ranges::copy(found, all.begin());
  comm_.broadcast(std::span<double>(all));
  values.assign(all);
}

void System::save(model::State& state, Snapshot& snapshot) {
  if (!snapshot.is_for_memory()) gather_forces(state);
  snapshot.set("state/time", state.time);
  save(state.next, "state/position", snapshot);
  save(state.velocity, "state/velocity", snapshot);
  snapshot.set("state/multipliers", state.multipliers);
  snapshot.set("state/own", state.own);
  snapshot.set("state/at rest", state.at_rest ? 1.0 : 0.0);
  snapshot.set("system/multiplier scale", multiplier_scale_);
  if (snapshot.is_for_memory()) {
    snapshot.set("system/carried",
                 carried_ ? std::span<const double>(*carried_) : std::span<const double>());
  } else {
    save_carried(snapshot);
  }
  const bool is_here = snapshot.is_for_memory();
  std::vector<double> numbers = memory(is_here ? model::Items::local : model::Items::owned);
  if (!is_here) comm_.sum(numbers);
  snapshot.set("system/batches", std::move(numbers));
}

std::vector<double> System::memory(model::Items which) const {
  std::vector<double> all(memory_size(), nothing);
  std::span<double> rest = all;
  for (const model::Batch* batch : batches_) {
    batch->save(which, rest.first(batch->memory_size()));
    rest = rest.subspan(batch->memory_size());
  }
  return all;
}

void System::restore_memory(std::span<const double> memory) {
  parallel::together(comm_, [&] {
    for (model::Batch* batch : batches_) {
      batch->restore(memory.first(batch->memory_size()));
      memory = memory.subspan(batch->memory_size());
    }
  });
}

std::size_t System::memory_size() const {
  std::size_t size = 0;
  for (const model::Batch* batch : batches_) size += batch->memory_size();
  return size;
}

bool System::fits(const Snapshot& snapshot, const model::State& state) const {
  const std::pair<const char*, std::size_t> sizes[] = {
      {"state/position", state.next.size()},
      {"state/multipliers", state.multipliers.size()},
      {"state/own", state.own.size()},
      {"system/batches", memory_size()}};
  return std::all_of(std::begin(sizes), std::end(sizes), [&](const auto& one) {
    return snapshot.has(one.first) && snapshot.numbers(one.first).size() == one.second;
  });
}

void System::restore(const Snapshot& snapshot, model::State& state) {
  state.time = state.time_prev = snapshot.number("state/time");
  const auto put = [](std::span<const double> numbers, auto&... targets) {
    (targets.assign(numbers.begin(), numbers.end()), ...);
  };
  const std::size_t size = state.next.size();
  restore(snapshot, "state/position", state.next);
  if (state.next.size() != size) {
    throw FileError(fmt::format("the checkpoint has {} numbers of 'state/position', the model {}",
                                state.next.size(), size));
  }
  state.prev = state.next;
  restore(snapshot, "state/velocity", state.velocity);
  state.acceleration_offset.assign(state.velocity.size(), 0.0);
  put(snapshot.numbers("state/multipliers", state.multipliers.size()), state.multipliers,
      state.multipliers_prev);
  put(snapshot.numbers("state/own", state.own.size()), state.own, state.own_prev);
  state.at_rest = snapshot.number("state/at rest") != 0.0;
  multiplier_scale_ = snapshot.number("system/multiplier scale");
  const std::span<const double> carried = snapshot.numbers("system/carried");
  if (!snapshot.is_for_memory()) {
    restore_carried({carried.begin(), carried.end()});
  } else if (carried.empty()) {
    carried_.reset();
  } else {
    carried_.emplace(carried.begin(), carried.end());
  }
  restore_memory(snapshot.numbers("system/batches", memory_size()));
}

// By global row, so that it does not depend on the number of ranks.
void System::save_carried(Snapshot& snapshot) const {
  const std::string name = "system/carried";
  const auto total = static_cast<std::size_t>(layout_.rows().total());
  if (!carried_) {
    snapshot.set(name, {});
  } else if (snapshot.is_shared()) {
    RowRanges rows;
    for (std::size_t row = 0; row < carried_->size(); ++row) {
      append_row(rows, static_cast<std::size_t>(layout_.rows().global(row)));
    }
    snapshot.add_table({name, total, 1, std::move(rows), [this] { return *carried_; }});
  } else {
    std::vector<double> all(total, nothing);
    for (std::size_t row = 0; row < carried_->size(); ++row) {
      all[static_cast<std::size_t>(layout_.rows().global(row))] = (*carried_)[row];
    }
    comm_.sum(all);
    snapshot.set(name, std::move(all));
  }
}

void System::restore_carried(const std::vector<double>& all) {
  carried_.reset();
  if (all.empty()) return;
  carried_.emplace(layout_.rows().size());
  for (std::size_t row = 0; row < carried_->size(); ++row) {
    (*carried_)[row] = all[static_cast<std::size_t>(layout_.rows().global(row))];
  }
}

// How many entries of the matrix the ranks before this one have.
std::size_t System::first_entry() const {
  const std::size_t mine = std::as_const(*matrix_).values().size();
  std::vector<double> ends(index(comm_.size()), 0.0);
  for (int rank = comm_.rank(); rank < comm_.size(); ++rank) {
    ends[index(rank)] = static_cast<double>(mine);
  }
  comm_.sum(ends);
  return static_cast<std::size_t>(ends[index(comm_.rank())]) - mine;
}

void System::save_matrix(Snapshot& snapshot) const {
  const auto mine = std::as_const(*matrix_).values();
  snapshot.set("matrix/ranks", comm_.size());
  if (snapshot.is_for_memory()) {
    snapshot.set("matrix/values", mine);
  } else {
    internal_check(snapshot.is_shared(), "a matrix is written by all ranks");
    // the ranks one after the other
    snapshot.add_table({"matrix/values",
                        static_cast<std::size_t>(matrix_->total_entries()),
                        1,
                        {{first_entry(), mine.size()}},
                        [mine] { return std::vector<double>(mine.begin(), mine.end()); }});
  }
  if (!tangent_point_.empty()) save(tangent_point_, "matrix/point", snapshot);
}

bool System::restore_matrix(const Snapshot& snapshot) {
  if (snapshot.integer("matrix/ranks") != comm_.size()) return false;
  if (snapshot.has("matrix/point")) restore(snapshot, "matrix/point", tangent_point_);
  const auto values = matrix_->values();
  if (snapshot.is_for_memory()) {
    std::ranges::copy(snapshot.numbers("matrix/values", values.size()), values.data());
    return true;
  }
  const std::span<const double> all = snapshot.numbers("matrix/values", matrix_->total_entries());
  std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first_entry()), values.size(),
              values.data());
  return true;
}

}  // namespace culm::assembly
