#include "load_watch.hpp"

#include <culm/base/text.hpp>
#include <culm/load/field_load.hpp>
#include <culm/load/moment_load.hpp>
#include <culm/load/pressure_load.hpp>
#include <culm/load/slot_load.hpp>
#include <culm/port/port_load.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace culm::simulation {
namespace {

// What is less of a load than this is rounding.
constexpr double negligible = 1e-12;
// A partner that answers with less than this, over what rounding leaves out of balance, has seen
// nothing else.
constexpr double echo = 10.0;

// A partner may act on what is driven, as a flow on a body that is made to oscillate.
bool is_of_partner(const model::Batch& load) {
  return dynamic_cast<const port::PortLoad*>(&load) != nullptr;
}

// Loads of ports and programs, which say by themselves that nobody sets them.
bool is_set_from_outside(const model::Batch& load) {
  return is_of_partner(load) || load.effect().type == "External";
}

// Elements that are heated are elements.
bool is_temperature(const model::Batch& batch) { return batch.effect().type == "Temperature"; }

// Whether there are bodies alone.
bool is_rigid(const model::Model& model) {
  return std::ranges::none_of(model.structures(), [](const model::Structure& structure) {
    return std::ranges::any_of(structure.cells,
                               [](const model::Cell& cell) { return cell.source != nullptr; });
  });
}

// In how many ways supports and joints let the nodes move.
int free_motions(const model::Model& model) {
  const model::UnknownTable& unknowns = model.unknowns();
  return unknowns.num_unknowns() - unknowns.num_signals() - 2 * unknowns.num_forces();
}

}  // namespace

bool is_given(const model::Batch& load) {
  return dynamic_cast<const load::SlotLoad*>(&load) != nullptr ||
         dynamic_cast<const load::MomentLoad*>(&load) != nullptr ||
         dynamic_cast<const load::PressureLoad*>(&load) != nullptr ||
         dynamic_cast<const load::FieldLoad*>(&load) != nullptr || is_of_partner(load);
}

bool goes_into_supports(const assembly::LoadShare& share) {
  return share.moving <= negligible * share.whole;
}

std::string idle_warning(const model::Batch& load) {
  return load.effect().quoted() +
         " moves nothing: all of it acts where supports hold the model and goes straight into them";
}

void LoadWatch::begin(const model::Model& model) {
  loads_.clear();
  has_stepped_ = false;
  hangs_ = is_rigid(model) && free_motions(model) > 0;
  is_driven_ = std::ranges::any_of(model.constraints(),
                                   [](const model::Constraint& c) { return c.is_driven(); });
  for (const auto& load : model.loads()) {
    if (is_given(*load)) loads_.push_back({load.get()});
  }
  for (const auto& batch : model.element_batches()) {
    if (is_temperature(*batch)) loads_.push_back({batch.get()});
  }
}

void LoadWatch::step(const assembly::System& system, const model::State& state, double theta,
                     double rounding) {
  has_stepped_ = true;
  std::vector<Load*> looked_at;
  std::vector<model::Batch*> batches;
  for (Load& load : loads_) {
    if (load.seen == Seen::moving) continue;
    looked_at.push_back(&load);
    batches.push_back(load.batch);
  }
  if (batches.empty()) return;
  const std::vector<assembly::LoadShare> shares = system.shares_of(batches, state, theta);
  for (std::size_t i = 0; i < looked_at.size(); ++i) {
    Load& load = *looked_at[i];
    const assembly::LoadShare& share = shares[i];
    if (share.whole == 0.0) continue;
    if (is_of_partner(*load.batch) && share.whole <= echo * rounding) continue;
    // what is heated between supports is strained all the same
    const bool is_lost = goes_into_supports(share) && !is_temperature(*load.batch);
    load.seen = is_lost ? Seen::held : Seen::moving;
  }
}

bool LoadWatch::any_acted() const {
  return std::any_of(loads_.begin(), loads_.end(),
                     [](const Load& load) { return load.seen != Seen::nothing; });
}

void LoadWatch::report(const model::State& state, bool is_last, Findings& findings) {
  report_held(state, findings);
  if (has_stepped_) {
    for (const Load& load : loads_) {
      if (is_set_from_outside(*load.batch)) continue;
      acted_[load.batch->effect().quoted()] |= load.seen != Seen::nothing;
    }
  }
  if (is_last) report_silent(state.time, findings);
}

void LoadWatch::report_silent(double time, Findings& findings) const {
  const auto is_silent = [](const auto& load) { return !load.second; };
  const auto count = std::ranges::count_if(acted_, is_silent);
  if (count == 0) return;
  const std::string& first = std::ranges::find_if(acted_, is_silent)->first;
  findings.warn("idle load",
                count == 1 ? first + " never acts: it is zero in all steps"
                           : fmt::format("{} loads, {} the first of them, never act: they are "
                                         "zero in all steps",
                                         count, first),
                time);
}

void LoadWatch::report_held(const model::State& state, Findings& findings) const {
  const auto count = [&](Seen seen) {
    return std::count_if(loads_.begin(), loads_.end(),
                         [&](const Load& load) { return load.seen == seen; });
  };
  const auto held = count(Seen::held);
  if (held == 0) return;
  const auto first = std::find_if(loads_.begin(), loads_.end(),
                                  [](const Load& load) { return load.seen == Seen::held; });
  const std::string text =
      held == 1 ? idle_warning(*first->batch)
                : fmt::format(
                      "{} loads, {} the first of them, move nothing: all of them act where "
                      "supports hold the model and go straight into them",
                      held, first->batch->effect().quoted());
  // what is driven has its weight all the same, and a body that hangs is where it belongs
  const bool all_expected = std::ranges::all_of(loads_, [&](const Load& load) {
    return load.seen != Seen::held || hangs_ || is_of_partner(*load.batch) ||
           (is_driven_ && load.batch->effect().type == "Gravity");
  });
  // shares that consistent loads have at supports belong to loads that act
  if (count(Seen::moving) == 0 && !all_expected) {
    findings.broken("idle load", text, state.time);
  } else {
    findings.warn("idle load", text, state.time);
  }
}

void LoadWatch::save(Snapshot& snapshot) const {
  std::vector<double> seen;
  for (const Load& load : loads_) seen.push_back(static_cast<double>(load.seen));
  snapshot.set("run/loads", std::move(seen));
  for (const bool acted : {true, false}) {
    std::vector<std::string> names;
    for (const auto& [name, did] : acted_) {
      if (did == acted) names.push_back(name);
    }
    snapshot.set_text(acted ? "run/acted" : "run/silent", join(names, "\n"));
  }
}

void LoadWatch::restore(const Snapshot& snapshot) {
  const std::span<const double> seen = snapshot.numbers("run/loads", loads_.size());
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    loads_[i].seen = static_cast<Seen>(static_cast<int>(seen[i]));
  }
  has_stepped_ = true;
  acted_.clear();
  for (const bool acted : {true, false}) {
    std::istringstream names(snapshot.text(acted ? "run/acted" : "run/silent"));
    for (std::string name; std::getline(names, name);) acted_[name] = acted;
  }
}

}  // namespace culm::simulation
