// How the state of a simulation comes from one analysis to the next.

#include <culm/load/link_load.hpp>
#include <culm/simulation/simulation.hpp>

#include "ended_ramps.hpp"
#include "late_supports.hpp"
#include "memories.hpp"
#include "other_run.hpp"
#include "simulation_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace culm::simulation {
namespace {

// Initial displacements are made to fit.
void warn_of_open_joints(Findings& findings, const Options& analysis, const model::Model& model,
                         const model::State& state, const model::Coordinates& q) {
  if (analysis.text("Type") != "Dynamic") return;
  if (state.at_rest && model.has_initial_displacements()) return;
  const double start = analysis.has("Start Time") ? analysis.number("Start Time") : state.time;
  for (const std::string& sentence : open_joints(model, q, start, analysis.name())) {
    findings.warn("open joint", sentence, start);
  }
}

bool acts_in(const model::Model& model, const model::Effect& effect) {
  return std::ranges::any_of(model.batches(),
                             [&](const model::Batch* batch) { return batch->effect() == effect; });
}

// Whether it carries more than where it is.
bool remembers(const model::Batch& batch) {
  const auto* link = dynamic_cast<const load::LinkLoad*>(&batch);
  return batch.memory_size() > 0 &&
         (link == nullptr || link->link(0).measure == load::Measure::angle);
}

// What an analysis begins anew, because the one before, `last`, does without it, and what acted in
// one before that.
std::vector<std::string> forgotten(const Phases& phases, std::size_t last, const Phase& phase) {
  std::vector<std::string> titles;
  for (const model::Batch* batch : phase.model->batches()) {
    if (!remembers(*batch) || acts_in(*phases.of(last).model, batch->effect())) continue;
    for (std::size_t earlier = 0; earlier < last; ++earlier) {
      if (!acts_in(*phases.of(earlier).model, batch->effect())) continue;
      titles.push_back(batch->effect().quoted());
      break;
    }
  }
  return titles;
}

}  // namespace

std::span<const double> Simulation::Parts::memories_at(const Options& analysis) const {
  const std::string& name = analysis.text("Start From");
  if (name == EarlierStates::reference) return first_memories;
  if (!earlier.wants(name)) return other_memories;
  return earlier.find(name).state.numbers(memories_key, first_memories.size());
}

// What is watched goes on from where the state comes from.
void Simulation::Parts::let_watch(ResultFiles& files, const Options& analysis, bool begins) {
  const Phase& phase = phases.of(present);
  files.use(*phase.system, phase.watched);
  if (begins && analysis.has("Start From")) files.restore_memories(memories_at(analysis));
}

void Simulation::Parts::let_remember(const Phase& before, const Options& analysis) {
  const std::vector<WatchedQuantity>& watched = phases.of(present).watched;
  hand_over_memories(before.watched, watched);
  if (analysis.has("Start From")) restore_memories(watched, memories_at(analysis));
}

// Brings the state to where an analysis starts, in its phase.
void Simulation::start_analysis(std::size_t number, model::State& state) {
  Parts& p = *parts_;
  const Options& entry = p.deck.list("Analyses").entries()[number];
  p.findings.begin(entry.name());
  move_state(number, state);
  const Phase& phase = p.phases.of(number);
  phase.system->forget_evaluation();
  // a run that is resumed knows no pivots of other analyses
  phase.linear.solver->set_pivots({});
  phase.linear.solver->remember_pivots();
  model::Coordinates q = state.next;
  phase.system->complete(q);
  refuse_left_supports(*phase.model, q, p.deck.list("Constraints"), entry.name());
  warn_of_open_joints(p.findings, entry, *phase.model, state, q);
  if (p.phases.leaves_path(number)) {
    for (const std::string& sentence : ramps_cut_off(p.deck, entry, state.time)) {
      p.findings.warn("ended ramp", sentence, state.time);
    }
  }
}

void Simulation::move_state(std::size_t number, model::State& state) {
  Parts& p = *parts_;
  const Options& entry = p.deck.list("Analyses").entries()[number];
  const std::size_t last = p.present;
  const Phase& before = p.phases.of(last);
  Phase& phase = p.phases.enter(number, p.comm, p.ledger);
  p.present = number;
  if (!entry.has("Start From")) {
    if (&phase == &before) return;
    for (const std::string& title : forgotten(p.phases, last, phase)) {
      p.findings.warn(
          "memory",
          fmt::format("{} begins anew: what it remembers, such as turns, or what flowed "
                      "or slid, is lost in the analysis before, where it is 'Inactive'",
                      title),
          state.time);
    }
    Snapshot saved;
    before.system->save(state, saved);
    state = phase.model->initial_state();
    phase.system->restore(hand_over(saved, before, phase), state);
    return;
  }
  const std::string& name = entry.text("Start From");
  state = phase.model->initial_state();
  if (name == EarlierStates::reference) {
    phase.system->restore(phase.reference, state);
  } else if (p.earlier.wants(name)) {
    const EarlierStates::Kept& kept = p.earlier.find(name);
    phase.system->restore(hand_over(kept.state, p.phases.of(kept.analysis), phase), state);
  } else {
    phase.system->restore(read_state(entry, phase, state), state);
  }
}

// The nodes of a checkpoint of another run, and what batches of the same effect, signals and
// quantities of the same name remember there; multipliers begin anew.
Snapshot Simulation::read_state(const Options& analysis, Phase& phase, model::State& state) {
  const Snapshot found = find_state_of_run(parts_->comm, analysis, *phase.model);
  Snapshot snapshot;
  phase.system->save(state, snapshot);
  for (const char* name : {"state/position", "state/velocity", "state/time", "state/at rest"}) {
    snapshot.set(name, found.numbers(name));
  }
  for (const std::string& title : take_memories(found, *phase.model, snapshot)) {
    parts_->findings.warn("memory",
                          fmt::format("'Start From' of '{}' leaves out what {} remembers in that "
                                      "run, such as what flowed or slid: here is none of its kind "
                                      "and size",
                                      analysis.name(), title),
                          state.time);
  }
  if (found.has("coupling/counts") && parts_->deck.has_list("Coupling")) {
    parts_->findings.warn(
        "coupling",
        fmt::format("'Start From' of '{}' does not take what the partners of that "
                    "run remember: those of this one begin anew",
                    analysis.name()),
        state.time);
  }
  snapshot.set(memories_key, parts_->first_memories);
  for (const std::string& name : take_watched(found, phase.watched, snapshot)) {
    parts_->findings.warn(
        "memory",
        fmt::format("History '{}' counts turns from here: the run that '{}' starts from does not "
                    "watch it, so that whole turns of before are lacking",
                    name, analysis.name()),
        state.time);
  }
  parts_->other_memories = snapshot.copy(memories_key);
  return snapshot;
}

void Simulation::keep_state(const std::string& name, model::State& state) {
  Parts& p = *parts_;
  if (!p.earlier.wants(name)) return;
  Snapshot snapshot;
  const Phase& phase = p.phases.of(p.present);
  phase.system->save(state, snapshot);
  snapshot.set(memories_key, memories_of(phase.watched));
  p.earlier.keep(name, p.present, std::move(snapshot));
}

}  // namespace culm::simulation
