// Simulations that another program drives, step by step.

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/simulation/input_files.hpp>
#include <culm/simulation/simulation.hpp>

#include "doubts.hpp"
#include "load_watch.hpp"
#include "port_picture.hpp"
#include "simulation_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::simulation {
namespace {

bool any_acts(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return value != 0.0; });
}

// Six numbers for each node.
void set_input(model::NodalInput& input, const std::vector<double>& values) {
  for (std::size_t i = 0; i < input.nodes().size(); ++i) {
    const double* v = values.data() + 6 * i;
    input.set(i, Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5]));
  }
}

}  // namespace

void Simulation::Parts::hear(const model::Effect& effect) {
  if (stepper == nullptr || !heard.insert(effect).second) return;
  for (const auto& load : phases.of(present).model->loads()) {
    if (load->effect().type != effect.type || load->effect().name != effect.name) continue;
    const assembly::LoadShare share = context->system.share_of(*load, state);
    if (share.whole == 0.0 || !goes_into_supports(share)) continue;
    findings.warn("idle load", idle_warning(*load), state.time);
  }
}

analysis::Stepper& Simulation::begin(const std::string& analysis) {
  Parts& p = *parts_;
  const std::vector<Options>& entries = p.deck.list("Analyses").entries();
  const analysis::AnalysisRegistry& known = p.catalogue.analyses;
  std::vector<std::string> names;
  std::size_t number = entries.size();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (known.inspections.contains(entries[i].text("Type"))) continue;
    names.push_back(entries[i].name());
    if (number == entries.size() && (analysis.empty() || analysis == entries[i].name())) number = i;
  }
  if (number == entries.size()) {
    throw UsageError("no analysis '" + analysis + "' of the deck makes steps" +
                     did_you_mean(analysis, names));
  }
  ++p.taken_up;
  if (p.state.next.empty()) {
    p.state = p.phases.of(p.present).model->initial_state();
    tell_of_deck(p.deck, p.findings, p.log);
    p.first_memories = memories_of(p.phases.of(p.present).watched);
  }
  end_analysis();
  if (p.deck.has_list("Coupling")) {
    p.findings.warn("coupling", "the partners of the deck do not act: a program makes the steps",
                    0.0);
  }
  p.phases.enter(p.present, p.comm, p.ledger);
  const Phase& before = p.phases.of(p.present);
  start_analysis(number, p.state);
  Phase& phase = p.phases.enter(number, p.comm, p.ledger);
  hand_over_loads(before, phase);
  for (const auto& [name, values] : p.set_loads) {
    const auto input = phase.model->inputs().find(name);
    if (input != phase.model->inputs().end()) set_input(*input->second, values);
  }
  p.findings.begin(entries[number].name());
  p.context.emplace(
      analysis::Context{*phase.system, *phase.linear.solver, p.ledger, p.log, p.findings});
  phase.system->synchronise(p.state);
  warn_before(p.deck, entries[number], *phase.model, p.state, p.findings);
  if (!phase.ports.empty()) warn_of_rates(entries[number], p.state, p.findings);
  auto stepper =
      known.steppers.make(entries[number].text("Type"), entries[number], *p.context, p.state);
  if (p.results != nullptr) {
    p.let_watch(p.results->files, entries[number], true);
    p.results->observer.begin(entries[number], number, false, *p.context, phase.linear);
    p.results->observer.follow(stepper.get(), nullptr, nullptr);
    p.results->observer.show_each_step();
    stepper->tell(&p.results->observer);
  } else {
    p.let_remember(before, entries[number]);
    p.keeper.emplace(*phase.system, phase.watched);
    stepper->tell(&*p.keeper);
  }
  stepper->fit();
  if (p.results != nullptr) {
    p.results->observer.start(p.state);
  } else {
    p.keeper->start(p.state);
  }
  stepper->begin();
  p.stepper = std::move(stepper);
  p.heard.clear();
  for (const auto& port : phase.ports) {
    if (port->is_loaded()) p.hear({"Port", port->name()});
  }
  for (const auto& [name, values] : p.set_loads) {
    if (any_acts(values)) p.hear({"External", name});
  }
  return *p.stepper;
}

analysis::Stepper* Simulation::stepper() { return parts_->stepper.get(); }

long Simulation::taken_up() const { return parts_->taken_up; }

void Simulation::end_analysis() {
  Parts& p = *parts_;
  if (p.stepper == nullptr) return;
  p.stepper->finish();
  p.stepper.reset();
  p.context->system.synchronise(p.state);
  p.warn_of_end(p.state.next, p.state.time);
  keep_state(p.deck.list("Analyses").entries()[p.present].name(), p.state);
}

void Simulation::write_results(const std::filesystem::path& folder) {
  Parts& p = *parts_;
  if (p.results != nullptr) throw UsageError("results are written already");
  if (!p.state.next.empty()) throw UsageError("results are wanted before the first 'begin'");
  refuse_overwriting_by_run(p.comm, find_input_files(p.deck, p.source), folder);
  RunSettings settings;
  settings.folder = folder;
  settings.quiet = true;
  p.results = open_results(settings, nullptr, nullptr);
  for (const std::string& name : port_names()) write_port(name, folder / port_picture(name));
}

bool Simulation::writes_results() const { return parts_->results != nullptr; }

std::string Simulation::close_results() {
  Parts& p = *parts_;
  if (p.results == nullptr) throw UsageError("no results are written");
  const bool is_done = p.stepper != nullptr && p.stepper->is_at_end();
  end_analysis();
  if (!p.state.next.empty()) {
    p.results->observer.end(p.state, is_done ? "done" : ended_from_outside);
  }
  std::string words = p.results->observer.closing_words();
  p.results.reset();
  return words;
}

void Simulation::set_load(const std::string& name, const std::vector<double>& values) {
  const auto& inputs = model().inputs();
  const auto found = inputs.find(name);
  if (found == inputs.end()) {
    const Options& analysis = parts_->deck.list("Analyses").entries()[parts_->present];
    const std::vector<std::string> idle = analysis.texts("Inactive");
    if (std::ranges::find(idle, name) != idle.end()) {
      throw UsageError("load '" + name + "' is 'Inactive' in '" + analysis.name() + "'");
    }
    std::vector<std::string> names;
    for (const auto& [known, input] : inputs) names.push_back(known);
    throw UsageError("there is no load '" + name + "' of type 'External'" +
                     did_you_mean(name, names));
  }
  model::NodalInput& input = *found->second;
  if (values.size() != 6 * input.nodes().size()) {
    throw UsageError(fmt::format("load '{}' acts on {} nodes and takes {} values, got {}", name,
                                 input.nodes().size(), 6 * input.nodes().size(), values.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw NonFiniteError(fmt::format("load '{}' got {} for component {} at node '{}'", name,
                                     values[i], i % 6, model().node_name(input.nodes()[i / 6])));
  }
  if (parts_->stepper != nullptr) parts_->stepper->outdate();
  set_input(input, values);
  parts_->set_loads[name] = values;
  if (any_acts(values)) parts_->hear({"External", name});
}

void Simulation::set_signal(const std::string& name, double value) {
  const auto& settings = model().settings();
  const auto found = settings.find(name);
  if (found == settings.end()) {
    std::vector<std::string> names;
    for (const auto& [known, signal] : settings) names.push_back(known);
    throw UsageError("there is no signal '" + name + "' of type 'External'" +
                     did_you_mean(name, names));
  }
  if (!std::isfinite(value)) {
    throw NonFiniteError(fmt::format("signal '{}' got {}", name, value));
  }
  if (parts_->stepper == nullptr) throw UsageError("there is no state yet: 'begin' comes first");
  parts_->stepper->outdate();
  const auto at = static_cast<std::size_t>(found->second.index);
  parts_->state.own[at] = parts_->state.own_prev[at] = value;
}

std::string Simulation::broken_promises() const { return parts_->findings.verdict(false); }

std::vector<int> Simulation::nodes(const std::string& name) const {
  const auto input = model().inputs().find(name);
  if (input != model().inputs().end()) return input->second->nodes();
  std::vector<int> found = model().select_nodes(name);
  if (found.empty()) {
    throw UsageError("there are no nodes '" + name + "'" +
                     did_you_mean(name, model().selectable_names()));
  }
  return found;
}

Vec3 Simulation::position(int node) { return model::NodeTable::slots(state().next, node).col(0); }

Vec3 Simulation::velocity(int node) {
  const model::State& now = state();
  if (now.velocity.empty()) return Vec3::Zero();
  return model::NodeTable::slots(now.velocity, node).col(0);
}

const model::State& Simulation::state() {
  Parts& p = *parts_;
  if (p.stepper == nullptr) throw UsageError("there is no state yet: 'begin' comes first");
  p.context->system.synchronise(p.state);
  return p.state;
}

std::vector<output::HistoryColumn> Simulation::quantity_columns() const {
  return columns_of(parts_->phases.of(parts_->present).watched);
}

// Of an open attempt as it would be accepted; what quantities remember is of accepted states.
// Without one those that were shown when the step was accepted: reactions and the like belong to
// the last attempt, which may have been thrown away.
std::vector<double> Simulation::quantities() {
  Parts& p = *parts_;
  if (p.stepper == nullptr) throw UsageError("there is no state yet: 'begin' comes first");
  if (!p.stepper->is_open()) {
    return p.results != nullptr ? p.results->observer.shown() : p.keeper->shown();
  }
  const std::vector<WatchedQuantity>& watched = p.phases.of(p.present).watched;
  const std::vector<double> memories = memories_of(watched);
  std::vector<double> numbers;
  p.stepper->preview([&](model::State& ahead) {
    p.context->system.synchronise(ahead);
    numbers = evaluate(watched, p.context->system, ahead);
  });
  restore_memories(watched, memories);
  return numbers;
}

const model::Model& Simulation::model() const { return *parts_->phases.of(parts_->present).model; }

}  // namespace culm::simulation
