#include <culm/analysis/dynamics.hpp>
#include <culm/base/error.hpp>
#include <culm/base/version.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/deck/resolved.hpp>
#include <culm/output/folder_lock.hpp>
#include <culm/port/report.hpp>
#include <culm/simulation/identity.hpp>
#include <culm/simulation/input_files.hpp>
#include <culm/simulation/resume.hpp>
#include <culm/simulation/simulation.hpp>
#include <culm/solver/fill.hpp>

#include "contact_findings.hpp"
#include "ended_ramps.hpp"
#include "gravity_and_sea.hpp"
#include "late_supports.hpp"
#include "lost_moments.hpp"
#include "model_picture.hpp"
#include "model_report.hpp"
#include "on_root.hpp"
#include "other_run.hpp"
#include "port_picture.hpp"
#include "relaxing_stresses.hpp"
#include "run_observer.hpp"
#include "served_run.hpp"
#include "simulation_parts.hpp"
#include "taut_beams.hpp"
#include "weightless.hpp"
#include "widths_in_media.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <typeinfo>
#include <utility>

namespace culm::simulation {
namespace {

// Of a factorisation that is worth a look at the start: some seconds.
constexpr double most_operations = 2e10;

bool is_numerical(const Error& error) {
  return dynamic_cast<const NumericalError*>(&error) != nullptr ||
         dynamic_cast<const NonFiniteError*>(&error) != nullptr;
}

// On rank 0, which writes.
std::unique_ptr<output::FolderLock> take_folder(const parallel::Comm& comm,
                                                const std::filesystem::path& folder,
                                                const Log& log) {
  std::unique_ptr<output::FolderLock> lock;
  on_root(comm, [&] { lock = std::make_unique<output::FolderLock>(folder); });
  if (lock != nullptr && !lock->weakness().empty()) {
    log.warning(
        fmt::format("{}: cannot be locked ({}): nothing keeps another run from writing here",
                    folder.string(), lock->weakness()));
  }
  return lock;
}

// Who a run is; the same as before if it goes on.
output::RunInfo describe_run(const Options& deck, const model::Model& model,
                             const parallel::Comm& comm, const Snapshot* from) {
  output::RunInfo info{deck.text("Title"), std::string(version), deck::resolved(deck)};
  info.run = from == nullptr ? new_run_identity(comm) : from->text("run/id");
  info.deck = identity_of(deck);
  info.model = identity_of(model, deck);
  if (from != nullptr && from->text("run/model") != info.model) {
    throw FileError(
        "the checkpoint belongs to another model than the one that the deck makes: a table, a mesh "
        "or another file that it reads has changed");
  }
  return info;
}

bool has_entry_of(const Options& list, const std::string& type) {
  return std::ranges::any_of(list.entries(),
                             [&](const Options& entry) { return entry.text("Type") == type; });
}

bool has_lost_velocities(const Options& deck) {
  return has_entry_of(deck.list("Initial Conditions"), "Velocity") &&
         !has_entry_of(deck.list("Analyses"), "Dynamic");
}

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

std::vector<std::string> names_of(const std::vector<Options>& entries) {
  std::vector<std::string> names;
  for (const Options& entry : entries) names.push_back(entry.name());
  return names;
}

}  // namespace

// Shapes that elements are too coarse for before any load.
void Simulation::Parts::warn_of_reference() {
  const Phase& phase = phases.of(0);
  const analysis::ElementTurns turns(*phase.system);
  const model::Coordinates& reference = phase.model->nodes().reference();
  const double share = turns.largest_share(reference);
  if (share <= 1.0) return;
  reference_turn = turns.find(reference, share);
  reference_turn.place = "before any load";
  const Where where = deck.list("Structures").list(reference_turn.structure).where();
  const std::string text = to_string(where) + ": " + reference_turn.warning();
  if (reference_turn.is_meaningless()) {
    findings.broken("turned element", text, 0.0);
  } else {
    findings.warn("turned element", text, 0.0);
  }
}

void Simulation::Parts::tell_of(const port::Port& port) {
  const model::Model& model = *phases.of(0).model;
  log.info(port::describe(port, model));
  for (const std::string& doubt : port::doubts(port, model)) findings.warn("port", doubt, 0.0);
}

std::unique_ptr<CoupledRun> Simulation::Parts::make_coupling(const CoupledFiles& files) {
  if (!deck.has_list("Coupling")) {
    if (files.replay.empty()) return nullptr;
    throw UsageError("a replay needs a deck with a list 'Coupling'");
  }
  return std::make_unique<CoupledRun>(deck, catalogue.partners, files, phases.of(present).ports,
                                      comm, findings);
}

Simulation::Simulation(const parallel::Comm& comm, const Catalogue& catalogue, const Options& deck,
                       DeckSource source, const Log& log, double memory)
    : Simulation(std::unique_ptr<Parts>(
          new Parts{comm, nullptr, catalogue, deck, std::move(source), log, memory})) {}

Simulation::Simulation(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
  parts_->phases.enter(0, parts_->comm, parts_->ledger);
  parts_->warn_of_reference();
  for (const auto& port : parts_->phases.of(0).ports) parts_->tell_of(*port);
}

Simulation Simulation::open(const std::string& path, std::vector<std::string> overrides,
                            const Log& log, const parallel::Comm& comm) {
  return of(read_source(comm, path, std::move(overrides)), log, comm);
}

Simulation Simulation::make(std::vector<std::string> assignments, const Log& log,
                            const parallel::Comm& comm) {
  return of({{{"assignments", "<ParameterList name=\"culm\"/>"}}, std::move(assignments)}, log,
            comm);
}

Simulation Simulation::of(DeckSource source, const Log& log, const parallel::Comm& comm) {
  const auto catalogue = std::make_shared<const Catalogue>();
  const Options deck = read_deck(*catalogue, source);
  return Simulation(std::unique_ptr<Parts>(
      new Parts{comm, catalogue, *catalogue, deck, std::move(source), log, machine_memory()}));
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::run(const RunSettings& settings, const StopRequest& request,
                     const Snapshot* from) {
  Parts& p = *parts_;
  refuse_overwriting_by_run(p.comm, find_input_files(p.deck, p.source), settings.folder);
  const Options& output = p.deck.list("Output");
  Checkpoints checkpoints(p.comm, settings.folder, output.flag("Checkpoints"),
                          output.number("Checkpoint Interval"), request);
  if (from != nullptr) {
    p.present = static_cast<std::size_t>(from->integer("run/analysis"));
    p.imperfections.restore(*from, *p.phases.of(p.present).model);
  }
  Phase& phase = p.phases.enter(p.present, p.comm, p.ledger);
  const std::unique_ptr<CoupledRun> coupled = p.make_coupling({settings.folder, settings.replay});
  const std::unique_ptr<ServedRun> served =
      settings.serve.address.empty()
          ? nullptr
          : std::make_unique<ServedRun>(p.deck, settings.serve, phase.ports, p.comm);
  if (from != nullptr && ServedRun::has_led(*from) != (served != nullptr)) {
    throw UsageError(served == nullptr
                         ? "this run was led by another program: say by --at where it comes to"
                         : "this run was led by nobody, and cannot follow another program now");
  }
  if (coupled != nullptr) checkpoints.begin_early();
  // from here on there is something on the disk
  const std::unique_ptr<Results> results = open_results(settings, &checkpoints, from);
  RunObserver& observer = results->observer;
  for (const auto& [name, input] : phase.model->inputs()) {
    p.findings.warn("external load",
                    "load '" + name + "' is zero: only a program that makes the steps can set it",
                    0.0);
  }
  for (const std::string& sentence : weightless_structures(p.deck)) {
    p.log.info("note: " + sentence);
  }
  if (has_lost_velocities(p.deck)) {
    p.findings.warn("initial velocities",
                    "the initial velocities of the deck are lost: they act in analyses of type "
                    "'Dynamic' only, and there is none",
                    0.0);
  }
  for (const auto& port : phase.ports) {
    if (coupled != nullptr && coupled->serves(port->name())) continue;
    if (served != nullptr && served->serves(port->name())) continue;
    p.findings.warn("port",
                    "port '" + port->name() +
                        "' has no loads: only partners, and programs that make the steps, set "
                        "them",
                    0.0);
  }
  for (const auto& port : phase.ports) {
    write_port(port->name(), settings.folder / port_picture(port->name()));
  }
  model::State state = phase.model->initial_state();
  try {
    if (from != nullptr) {
      p.findings.restore(*from);
      observer.restore(*from);
      p.earlier.restore(*from);
      if (coupled != nullptr) coupled->restore(*from);
      if (served != nullptr) served->restore(*from);
    }
    run_analyses(state, observer, results->files, coupled.get(), served.get(), from);
    if (coupled != nullptr) {
      coupled->report_left_over(state.time);
      coupled->end("");
    }
    if (served != nullptr) served->end("");
  } catch (const Error& error) {
    // short, and without the command that is for the user: a partner that is stuck does not take a
    // long message over MPI
    const std::string why = error.what();
    if (coupled != nullptr) coupled->end(why.substr(0, why.find("\nGo on with: ")));
    if (served != nullptr) served->end(error.what());
    try {
      observer.end(state, error.what());
    } catch (const Error& second) {
      // the first error is the one to report; of two of a kind the second only repeats it
      if (typeid(error) != typeid(second)) p.log.warning(second.what());
    }
    throw;
  }
  observer.end(state, "done");
  if (!settings.quiet) p.log.info(observer.closing_words());
  const std::string verdict = p.findings.verdict(settings.strict);
  if (!verdict.empty()) throw PromiseBroken(verdict);
}

std::unique_ptr<Simulation::Results> Simulation::open_results(const RunSettings& settings,
                                                              Checkpoints* checkpoints,
                                                              const Snapshot* from) {
  Parts& p = *parts_;
  const Options& output = p.deck.list("Output");
  const Phase& phase = p.phases.enter(p.present, p.comm, p.ledger);  // a new port took its system
  const ResultSettings wanted = {settings.folder,
                                 describe_run(p.deck, *p.phases.of(0).model, p.comm, from),
                                 names_of(p.deck.list("Analyses").entries()),
                                 output.integer("Every"),
                                 output.flag("Pictures"),
                                 static_cast<std::size_t>(output.integer("Most Pictures")),
                                 read_layer_settings(output.list("Shell"), *phase.model),
                                 output.flag("Velocities"),
                                 output.flag("Constraint Forces")};
  auto lock = take_folder(p.comm, settings.folder, p.log);
  return std::make_unique<Results>(p, settings, wanted, std::move(lock), checkpoints, from);
}

Simulation::Results::Results(Parts& p, const RunSettings& settings, const ResultSettings& wanted,
                             std::unique_ptr<output::FolderLock> taken, Checkpoints* checkpoints,
                             const Snapshot* from)
    : lock(std::move(taken)),
      files(*p.phases.of(p.present).system, *p.phases.of(0).model, wanted,
            p.phases.of(p.present).watched, from),
      observer(p.ledger, p.findings, files, checkpoints, p.source, p.earlier, p.imperfections,
               p.reference_turn, Progress(p.log, settings.quiet, settings.terminal)) {}

void Simulation::run_analyses(model::State& state, RunObserver& observer, ResultFiles& files,
                              CoupledRun* coupled, ServedRun* served, const Snapshot* from) {
  Parts& p = *parts_;
  const std::vector<Options>& entries = p.deck.list("Analyses").entries();
  const std::size_t first = p.present;
  for (std::size_t i = first; i < entries.size(); ++i) {
    const bool resumes = from != nullptr && i == first;
    Phase& phase = p.phases.enter(i, p.comm, p.ledger);
    if (!resumes) start_analysis(i, state);
    phase.system->synchronise(state);
    p.let_watch(files, entries[i], !resumes);
    analysis::Context context{*phase.system, *phase.linear.solver, p.ledger, p.log, p.findings};
    if (!resumes) phase.system->forget_reactions();
    observer.begin(entries[i], i, i + 1 == entries.size(), context, phase.linear);
    if (resumes) observer.resume(*from);
    const auto warn = [&](const char* kind, const std::vector<std::string>& sentences) {
      for (const std::string& sentence : sentences) p.findings.warn(kind, sentence, state.time);
    };
    warn("gravity", weights_that_miss_seas(p.deck, entries[i]));
    warn("width", widths_that_differ(p.deck, entries[i], *phase.model));
    warn("ended ramp", levels_beyond_ramp(p.deck, entries[i]));
    warn("relaxation", stresses_without_branches(p.deck, entries[i]));
    warn("overlap", deep_contacts(*phase.model, state.next));
    if (entries[i].text("Type") != "Dynamic") warn("friction", contacts_at_rest(*phase.model));
    warn("lost moment", moments_that_are_not_carried(*phase.model));
    const auto warn_of_kinks = [&](const model::Coordinates& q) {
      warn("taut beam", taut_beams(*phase.system, q));
    };
    analysis::AnalysisReport report;
    try {
      report = run_analysis(entries[i], context, state, observer, coupled, served,
                            resumes ? from : nullptr);
    } catch (const NumericalError&) {
      warn_of_kinks(state.prev);
      throw;
    }
    warn_of_kinks(state.next);
    p.imperfections.keep(entries[i].name(), *phase.model, report);
    keep_state(entries[i].name(), state, &files);
  }
}

analysis::AnalysisReport Simulation::run_analysis(const Options& entry, analysis::Context& context,
                                                  model::State& state, RunObserver& observer,
                                                  CoupledRun* coupled, ServedRun* served,
                                                  const Snapshot* from) {
  const analysis::AnalysisRegistry& known = parts_->catalogue.analyses;
  const std::string& type = entry.text("Type");
  if (known.inspections.contains(type)) {
    const auto inspection = known.inspections.make(type, entry);
    const auto& entries = parts_->deck.list("Analyses").entries();
    const bool steps_follow = std::any_of(entries.begin(), entries.end(), [&](const Options& one) {
      return !known.inspections.contains(one.text("Type"));
    });
    observer.start_run(state, steps_follow);
    inspection->begin(context, state);
    const analysis::AnalysisReport report = inspection->inspect(context, state);
    observer.finish(report, state);
    return report;
  }
  if (!inspection_follows()) context.system.forget_other_items();
  const auto stepper = known.steppers.make(type, entry, context, state);
  const bool is_motion = dynamic_cast<const analysis::Dynamics*>(stepper.get()) != nullptr;
  observer.follow(stepper.get(), coupled, is_motion ? served : nullptr);
  if (from != nullptr) {
    stepper->resume(*from);
  } else {
    stepper->fit();
    observer.start(state);
    stepper->begin();
  }
  try {
    const Ports& ports = parts_->phases.of(parts_->present).ports;
    const auto make_steps = [&] {
      if (is_motion && served != nullptr) {
        return served->run(*stepper, context.system, ports, observer);
      }
      if (is_motion && coupled != nullptr) {
        return coupled->run(*stepper, context.system, ports, observer);
      }
      return analysis::run(*stepper, observer);
    };
    const analysis::AnalysisReport report = make_steps();
    observer.finish(report, state);
    return report;
  } catch (const PartnerError& error) {
    // it cannot save what it is any more: what counts is the checkpoint that it shares
    throw PartnerError(error.what() + observer.way_on());
  } catch (const Error& error) {
    // other tolerances or steps may find the way that these did not
    if (is_numerical(error) && served == nullptr) write_last_checkpoint(observer);
    if (coupled == nullptr || dynamic_cast<const NumericalError*>(&error) == nullptr) throw;
    throw NumericalError(error.what() + observer.way_on());
  }
}

// Whether an analysis after the present one looks at a state; such ones want all elements.
bool Simulation::inspection_follows() const {
  const auto& entries = parts_->deck.list("Analyses").entries();
  const auto& inspections = parts_->catalogue.analyses.inspections;
  return std::any_of(entries.begin() + static_cast<std::ptrdiff_t>(parts_->present), entries.end(),
                     [&](const Options& one) { return inspections.contains(one.text("Type")); });
}

// What is watched goes on from where the state comes from.
void Simulation::Parts::let_watch(ResultFiles& files, const Options& analysis, bool begins) {
  const Phase& phase = phases.of(present);
  files.use(*phase.system, phase.watched);
  if (!begins || !analysis.has("Start From")) return;
  const std::string& name = analysis.text("Start From");
  files.restore_memories(earlier.wants(name) ? &earlier.find(name).state : nullptr);
}

// Brings the state to where an analysis starts, in its phase.
void Simulation::start_analysis(std::size_t number, model::State& state) {
  Parts& p = *parts_;
  const Options& entry = p.deck.list("Analyses").entries()[number];
  p.findings.begin(entry.name());
  move_state(number, state);
  const Phase& phase = p.phases.of(number);
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
  const Phase& before = p.phases.of(p.present);
  Phase& phase = p.phases.enter(number, p.comm, p.ledger);
  p.present = number;
  if (!entry.has("Start From")) {
    if (&phase == &before) return;
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

// The nodes of a checkpoint of another run, and what batches of the same effect and signals of the
// same name remember there; multipliers begin anew.
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
  return snapshot;
}

void Simulation::keep_state(const std::string& name, model::State& state,
                            const ResultFiles* files) {
  Parts& p = *parts_;
  if (!p.earlier.wants(name)) return;
  Snapshot snapshot;
  p.phases.of(p.present).system->save(state, snapshot);
  if (files != nullptr) files->save_memories(snapshot);
  p.earlier.keep(name, p.present, std::move(snapshot));
}

void Simulation::write_last_checkpoint(RunObserver& observer) const {
  try {
    observer.write_checkpoint();
  } catch (const FileError& second) {
    parts_->log.warning(second.what());
  } catch (const PartnerError& second) {
    parts_->log.warning(second.what());
  }
}

void Simulation::examine() {
  Parts& p = *parts_;
  p.make_coupling({});
  const std::vector<Options>& entries = p.deck.list("Analyses").entries();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool from_reference =
        entries[i].has("Start From") && entries[i].text("Start From") == EarlierStates::reference;
    // imperfections that analyses find are not known yet
    if ((i > 0 && !from_reference) || !p.phases.of(i).bent_by.empty()) continue;
    Phase& phase = p.phases.enter(i, p.comm, p.ledger);
    const double operations = solver::predict_fill(*phase.system->matrix(), p.comm).operations;
    if (operations > most_operations) {
      p.log.info(
          fmt::format("note: '{}' was not searched for mechanisms: a factorisation of this "
                      "model takes {:.1e} operations; 'culm run' looks before the first "
                      "step",
                      entries[i].name(), operations));
      continue;
    }
    model::State state = phase.model->initial_state();
    start_analysis(i, state);
    analysis::Context context{*phase.system, *phase.linear.solver, p.ledger, p.log, p.findings};
    const analysis::AnalysisRegistry& known = p.catalogue.analyses;
    const std::string& type = entries[i].text("Type");
    if (known.inspections.contains(type)) {
      known.inspections.make(type, entries[i])->begin(context, state);
    } else {
      known.steppers.make(type, entries[i], context, state)->begin();
    }
  }
}

void Simulation::write_model(const std::filesystem::path& path) {
  Parts& p = *parts_;
  const Phase& phase = p.phases.enter(0, p.comm, p.ledger);
  const Options& first = p.deck.list("Analyses").entries().front();
  const double end = first.text("Type") == "Dynamic" ? first.number("End Time") : 1.0;
  draw_model(*phase.system, describe_run(p.deck, *phase.model, p.comm, nullptr), end, path);
}

std::string Simulation::summary() const {
  const Phase& phase = parts_->phases.of(0);
  model::MemoryNeed need = phase.need;
  need.factors = factors_by_graph(phase, parts_->comm);
  const model::Model& model = *phase.model;
  const auto entries = phase.system->matrix()->total_entries();
  std::string text = report_masses(model) + '\n';
  if (const std::string constraints = report_constraints(model); !constraints.empty()) {
    text += constraints + '\n';
  }
  text += report_unknowns(model) + fmt::format("matrix entries: {}\n", entries);
  text += fmt::format("linear solver: {}\n", phase.linear.reason);
  text += fmt::format("memory, predicted: {}\n\n", need.text());
  text +=
      fmt::format("{:<40} {:>10} {:>10} {:>14}\n", "effect", "items", "unknowns", "entries/iter");
  const auto count = [](const std::optional<long long>& n) {
    return n ? std::to_string(*n) : std::string("-");
  };
  for (const Ledger::Entry& e : parts_->ledger.entries()) {
    if (!e.items) continue;
    text += fmt::format("{:<40} {:>10} {:>10} {:>14}\n", e.name, count(e.items), count(e.unknowns),
                        count(e.entries_per_iteration));
  }
  return text;
}

}  // namespace culm::simulation
