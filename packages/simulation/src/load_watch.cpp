#include "load_watch.hpp"

#include <culm/load/moment_load.hpp>
#include <culm/load/pressure_load.hpp>
#include <culm/load/slot_load.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace culm::simulation {
namespace {

// What is less of a load than this is rounding.
constexpr double negligible = 1e-12;

}  // namespace

bool is_given(const model::Batch& load) {
  return dynamic_cast<const load::SlotLoad*>(&load) != nullptr ||
         dynamic_cast<const load::MomentLoad*>(&load) != nullptr ||
         dynamic_cast<const load::PressureLoad*>(&load) != nullptr;
}

void LoadWatch::begin(const model::Model& model) {
  loads_.clear();
  for (const auto& load : model.loads()) {
    if (is_given(*load)) loads_.push_back({load.get()});
  }
}

void LoadWatch::step(const assembly::System& system, const model::State& state) {
  for (Load& load : loads_) {
    if (load.seen == Seen::moving) continue;
    const assembly::LoadShare share = system.share_of(*load.batch, state);
    if (share.whole == 0.0) continue;
    load.seen = share.moving > negligible * share.whole ? Seen::moving : Seen::held;
  }
}

bool LoadWatch::any_acted() const {
  return std::any_of(loads_.begin(), loads_.end(),
                     [](const Load& load) { return load.seen != Seen::nothing; });
}

void LoadWatch::report(const model::State& state, Findings& findings) const {
  const auto count = [&](Seen seen) {
    return std::count_if(loads_.begin(), loads_.end(),
                         [&](const Load& load) { return load.seen == seen; });
  };
  const auto held = count(Seen::held);
  if (held == 0) return;
  const auto first = std::find_if(loads_.begin(), loads_.end(),
                                  [](const Load& load) { return load.seen == Seen::held; });
  const std::string text =
      held == 1 ? fmt::format(
                      "{} moves nothing: all of it acts where supports hold the model and "
                      "goes straight into them",
                      first->batch->effect().quoted())
                : fmt::format(
                      "{} loads, {} the first of them, move nothing: all of them act where "
                      "supports hold the model and go straight into them",
                      held, first->batch->effect().quoted());
  // shares that consistent loads have at supports belong to loads that act
  if (count(Seen::moving) == 0) {
    findings.broken("idle load", text, state.time);
  } else {
    findings.warn("idle load", text, state.time);
  }
}

void LoadWatch::save(Snapshot& snapshot) const {
  std::vector<double> seen;
  for (const Load& load : loads_) seen.push_back(static_cast<double>(load.seen));
  snapshot.set("run/loads", std::move(seen));
}

void LoadWatch::restore(const Snapshot& snapshot) {
  const std::span<const double> seen = snapshot.numbers("run/loads", loads_.size());
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    loads_[i].seen = static_cast<Seen>(static_cast<int>(seen[i]));
  }
}

}  // namespace culm::simulation
