#include "memories.hpp"

#include <culm/base/error.hpp>

#include <algorithm>

namespace culm::simulation {
std::vector<double> memories_of(const std::vector<WatchedQuantity>& watched) {
  std::vector<double> all;
  for (const WatchedQuantity& one : watched) {
    const std::vector<double> memory = one.quantity->memory();
    all.insert(all.end(), memory.begin(), memory.end());
  }
  return all;
}

void restore_memories(const std::vector<WatchedQuantity>& watched,
                      std::span<const double> memories) {
  for (const WatchedQuantity& one : watched) {
    const std::size_t size = one.quantity->memory().size();
    one.quantity->restore(memories.first(size));
    memories = memories.subspan(size);
  }
}

void hand_over_memories(const std::vector<WatchedQuantity>& from,
                        const std::vector<WatchedQuantity>& to) {
  if (&from == &to) return;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::vector<double> memory = from[i].quantity->memory();
    // what does not act in a phase remembers nothing there
    if (to[i].quantity->memory().size() == memory.size()) to[i].quantity->restore(memory);
  }
}

void MemoryKeeper::start(model::State& state) {
  model::State first = unsolved(system_.model(), state);
  show(first);
}

void MemoryKeeper::step(const analysis::StepReport& report, model::State& state) {
  if (report.accepted) show(state);
}

void MemoryKeeper::keep(Snapshot& snapshot) const {
  snapshot.set(memories_key, memories_of(watched_));
  snapshot.set(shown_key, shown_);
}

void MemoryKeeper::go_back(const Snapshot& kept) {
  const std::size_t size = memories_of(watched_).size();
  if (!kept.has(memories_key))
    throw UsageError("the snapshot knows nothing of what is watched here");
  restore_memories(watched_, kept.numbers(memories_key, size));
  const std::span<const double> shown = kept.numbers(shown_key);
  shown_.assign(shown.begin(), shown.end());
}

void MemoryKeeper::show(model::State& state) {
  if (watched_.empty()) return;
  if (nodes_) {
    system_.synchronise(state, *nodes_);
  } else {
    system_.synchronise(state);
  }
  shown_ = evaluate(watched_, system_, state);
}

model::State unsolved(const model::Model& model, const model::State& state) {
  model::State result = state;
  std::fill(result.multipliers.begin(), result.multipliers.end(), 0.0);
  for (const model::OwnBlock& block : model.own_blocks()) {
    for (std::size_t i = 0; i < block.unknowns.size(); ++i) {
      if (block.unknowns[i].kind != model::UnknownKind::multiplier) continue;
      result.own[static_cast<std::size_t>(block.first) + i] = 0.0;
    }
  }
  return result;
}

bool remember(const std::vector<WatchedQuantity>& watched) {
  return std::ranges::any_of(
      watched, [](const WatchedQuantity& one) { return !one.quantity->memory().empty(); });
}

}  // namespace culm::simulation
