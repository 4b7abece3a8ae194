#include <culm/analysis/dynamics.hpp>
#include <culm/base/error.hpp>
#include <culm/base/file_pages.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/port/report.hpp>
#include <culm/simulation/input_files.hpp>
#include <culm/simulation/resume.hpp>
#include <culm/simulation/simulation.hpp>

#include "contact_findings.hpp"
#include "doubts.hpp"
#include "memories.hpp"
#include "port_picture.hpp"
#include "run_observer.hpp"
#include "served_run.hpp"
#include "simulation_parts.hpp"
#include "taut_beams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <typeinfo>
#include <utility>

namespace culm::simulation {
namespace {

// What has read decks, built models and prepared analyses is not needed in their steps.
void give_back_pages_of_start(const model::Model& model) {
  constexpr int many_nodes = 10'000;  // a step of theirs takes as long as giving back
  if (model.nodes().size() >= many_nodes) give_back_file_pages();
}

bool is_numerical(const Error& error) {
  return dynamic_cast<const NumericalError*>(&error) != nullptr ||
         dynamic_cast<const NonFiniteError*>(&error) != nullptr;
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

void Simulation::Parts::warn_of_end(const model::Coordinates& q, double time) {
  for (const std::string& sentence : taut_beams(*phases.of(present).system, q)) {
    findings.warn("taut beam", sentence, time);
  }
  const Phase& phase = phases.of(present);
  if (!has_contacts(*phase.model)) return;
  model::Coordinates whole = q;
  phase.system->complete(whole);
  for (const std::string& sentence : coarse_contacts(*phase.model, whole)) {
    findings.warn("coarse contact", sentence, time);
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

Simulation::Simulation(const parallel::Comm& comm, const Catalogue& catalogue, Options deck,
                       DeckSource source, const Log& log, double memory)
    : Simulation(
          std::unique_ptr<Parts>(new Parts{comm, nullptr, catalogue, std::move(deck),
                                           std::move(source), log, least_memory(memory, comm)})) {}

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
  Options deck = read_deck(*catalogue, source);
  return Simulation(std::unique_ptr<Parts>(
      new Parts{comm, catalogue, *catalogue, std::move(deck), std::move(source), log,
                least_memory(machine_memory(comm.most_on_a_machine()), comm)}));
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

const Options& Simulation::deck() const { return parts_->deck; }

void Simulation::run(const RunSettings& settings, const StopRequest& request,
                     const Snapshot* from) {
  Parts& p = *parts_;
  refuse_overwriting_by_run(p.comm, find_input_files(p.deck, p.source), settings.folder);
  p.phases.refuse_late_starts();
  const Options& output = p.deck.list("Output");
  Checkpoints checkpoints(p.comm, settings.folder, output.flag("Checkpoints"),
                          output.number("Checkpoint Interval"), request);
  if (from != nullptr) {
    p.present = static_cast<std::size_t>(from->integer("run/analysis"));
    p.imperfections.restore(*from, *p.phases.of(p.present).model);
  }
  Phase& phase = p.phases.enter(p.present, p.comm, p.ledger);
  p.first_memories = memories_of(phase.watched);
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
  tell_of_deck(p.deck, p.findings, p.log);
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
    // a bug may show on one rank alone, and nobody would join it in what follows
    const bool is_bug = dynamic_cast<const InternalError*>(&error) != nullptr;
    if (is_bug && p.comm.size() > 1) throw;
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
  const bool was_left = served != nullptr && served->was_left();
  observer.end(state, was_left ? ended_from_outside : "done");
  if (!settings.quiet) p.log.info(observer.closing_words());
  const std::string verdict = p.findings.verdict(settings.strict);
  if (!verdict.empty()) throw PromiseBroken(verdict);
}

void Simulation::run_analyses(model::State& state, RunObserver& observer, ResultFiles& files,
                              CoupledRun* coupled, ServedRun* served, const Snapshot* from) {
  Parts& p = *parts_;
  const std::vector<Options>& entries = p.deck.list("Analyses").entries();
  const std::size_t first = p.present;
  for (std::size_t i = first; i < entries.size(); ++i) {
    const bool resumes = from != nullptr && i == first;
    Phase& phase = p.phases.enter(i, p.comm, p.ledger);
    give_back_pages_of_start(*phase.model);
    if (!resumes) start_analysis(i, state);
    phase.system->synchronise(state);
    p.let_watch(files, entries[i], !resumes);
    analysis::Context context{*phase.system, *phase.linear.solver, p.ledger, p.log, p.findings};
    observer.begin(entries[i], i, i + 1 == entries.size(), context, phase.linear);
    if (resumes) observer.resume(*from);
    warn_before(p.deck, entries[i], *phase.model, state, p.findings);
    if (coupled != nullptr || served != nullptr) warn_of_rates(entries[i], state, p.findings);
    analysis::AnalysisReport report;
    try {
      report = run_analysis(entries[i], context, state, observer, coupled, served,
                            resumes ? from : nullptr);
    } catch (const NumericalError&) {
      p.warn_of_end(state.prev, state.time);
      throw;
    }
    p.warn_of_end(state.next, state.time);
    p.imperfections.keep(entries[i].name(), *phase.model, report);
    keep_state(entries[i].name(), state);
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
    observer.start_run(state, has_type(0, false));
    if (entry.has("Start From")) observer.record_start(state);
    inspection->begin(context, state);
    const analysis::AnalysisReport report = inspection->inspect(context, state);
    observer.finish(report, state);
    return report;
  }
  if (!has_type(parts_->present, true)) context.system.forget_other_items();
  const auto stepper = known.steppers.make(type, entry, context, state);
  const bool is_motion = dynamic_cast<const analysis::Dynamics*>(stepper.get()) != nullptr;
  observer.follow(stepper.get(), coupled, is_motion ? served : nullptr);
  if (!has_type(parts_->present + 1, false)) observer.keep_end();
  give_back_pages_of_start(context.system.model());  // before the first factors
  if (from != nullptr) {
    stepper->resume(*from);
  } else {
    stepper->fit();
    observer.start(state);
    stepper->begin();
  }
  give_back_pages_of_start(context.system.model());
  try {
    const Phase& phase = parts_->phases.of(parts_->present);
    const Ports& ports = phase.ports;
    const auto make_steps = [&] {
      if (is_motion && served != nullptr) {
        return served->run(*stepper, context.system, ports, observer);
      }
      if (is_motion && coupled != nullptr) {
        if (from == nullptr && entry.has("Start From")) coupled->stay(entry.name(), state.time);
        return coupled->run(*stepper, context.system, ports, phase.watched, observer);
      }
      return analysis::run(*stepper, observer);
    };
    const analysis::AnalysisReport report = make_steps();
    observer.finish(report, state);
    return report;
  } catch (const PartnerError& error) {
    // it cannot save what it is any more: what counts is the checkpoint that it shares
    throw PartnerError(error.what() + observer.way_on());
  } catch (const Stopped& error) {
    if (observer.has_said_farewell()) throw;
    throw Stopped(error.what() + observer.way_on());
  } catch (const Error& error) {
    // other tolerances or steps may find the way that these did not
    if (is_numerical(error) && served == nullptr) write_last_checkpoint(observer);
    if (coupled == nullptr || dynamic_cast<const NumericalError*>(&error) == nullptr) throw;
    throw NumericalError(error.what() + observer.way_on());
  }
}

// Whether an analysis of the deck, from a number on, looks at a state, or else makes steps. Those
// that look want all elements.
bool Simulation::has_type(std::size_t first, bool inspects) const {
  const auto& entries = parts_->deck.list("Analyses").entries();
  const auto& inspections = parts_->catalogue.analyses.inspections;
  return std::any_of(
      entries.begin() + static_cast<std::ptrdiff_t>(first), entries.end(),
      [&](const Options& one) { return inspections.contains(one.text("Type")) == inspects; });
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

}  // namespace culm::simulation
