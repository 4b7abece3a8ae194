#include <culm/base/error.hpp>
#include <culm/base/version.hpp>
#include <culm/deck/resolved.hpp>
#include <culm/simulation/simulation.hpp>

#include "model_builder.hpp"
#include "model_report.hpp"
#include "run_observer.hpp"

#include <fmt/format.h>

#include <utility>

namespace culm::simulation {
namespace {

bool is_numerical(const Error& error) {
  return dynamic_cast<const NumericalError*>(&error) != nullptr ||
         dynamic_cast<const NonFiniteError*>(&error) != nullptr;
}

}  // namespace

struct Simulation::Parts {
  parallel::Comm comm;
  const Catalogue& catalogue;
  Options deck;
  DeckSource source;
  Log log;
  Ledger ledger;
  model::Model model;
  std::vector<WatchedQuantity> watched;
  std::unique_ptr<assembly::System> system;
  solver::ChosenSolver linear;
};

Simulation::Simulation(const parallel::Comm& comm, const Catalogue& catalogue, const Options& deck,
                       DeckSource source, const Log& log)
    : parts_(new Parts{comm, catalogue, deck, std::move(source), log, {}, {}, {}, {}, {}}) {
  Parts& p = *parts_;
  p.watched = build_model(catalogue, deck, log, p.model);
  p.system = std::make_unique<assembly::System>(p.model, comm, p.ledger);
  p.linear = solver::choose_linear_solver(deck.list("Solver").text("Linear Solver"),
                                          p.system->matrix(), comm);
}

Simulation::~Simulation() = default;

void Simulation::run(const RunSettings& settings, const StopRequest& request,
                     const Snapshot* from) {
  Parts& p = *parts_;
  const Options& output = p.deck.list("Output");
  Checkpoints checkpoints(p.comm, settings.folder, output.flag("Checkpoints"),
                          output.number("Checkpoint Interval"), request);
  ResultFiles files(*p.system,
                    {settings.folder,
                     {p.deck.text("Title"), std::string(version), deck::resolved(p.deck)},
                     output.integer("Every"),
                     output.flag("Pictures"),
                     read_layer_settings(output.list("Shell"), p.model)},
                    p.watched, from);
  analysis::Context context{*p.system, *p.linear.solver, p.ledger, p.log};
  RunObserver observer(context, files, checkpoints, p.source, p.linear.reason,
                       Progress(p.log, settings.quiet, settings.terminal));
  model::State state = p.model.initial_state();
  try {
    if (from == nullptr) {
      observer.start(state);
    } else {
      p.system->restore(*from, state);
      observer.restore(*from);
    }
    run_analyses(context, state, observer, from);
  } catch (const Error& error) {
    try {
      observer.end(state, error.what());
    } catch (const FileError& second) {
      // the first error is the one to report; of two about files the second only repeats it
      if (dynamic_cast<const FileError*>(&error) == nullptr) p.log.warning(second.what());
    }
    throw;
  }
  observer.end(state, "done");
  if (!settings.quiet) p.log.info(observer.closing_words());
}

void Simulation::run_analyses(analysis::Context& context, model::State& state,
                              RunObserver& observer, const Snapshot* from) const {
  const std::vector<Options>& entries = parts_->deck.list("Analyses").entries();
  const auto first =
      from == nullptr ? std::size_t{0} : static_cast<std::size_t>(from->integer("run/analysis"));
  for (std::size_t i = first; i < entries.size(); ++i) {
    const auto analysis = parts_->catalogue.analyses.make(entries[i].text("Type"), entries[i]);
    observer.begin(entries[i].name(), i, i + 1 == entries.size(), *analysis);
    const bool resumes = from != nullptr && i == first;
    try {
      const auto report = resumes ? analysis->resume(context, state, observer, *from)
                                  : analysis->run(context, state, observer);
      observer.finish_analysis(report, state);
    } catch (const Error& error) {
      // other tolerances or steps may find the way that these did not
      if (is_numerical(error)) write_last_checkpoint(state, observer);
      throw;
    }
  }
}

void Simulation::write_last_checkpoint(model::State& state, RunObserver& observer) const {
  try {
    observer.write_checkpoint(state);
  } catch (const FileError& second) {
    parts_->log.warning(second.what());
  }
}

std::string Simulation::summary() const {
  const model::Model& model = parts_->model;
  const auto entries = parts_->system->matrix()->getGlobalNumEntries();
  std::string text = report_masses(model) + '\n';
  if (const std::string constraints = report_constraints(model); !constraints.empty()) {
    text += constraints + '\n';
  }
  text += report_unknowns(model) + fmt::format("matrix entries: {}\n", entries);
  text += fmt::format("linear solver: {}\n\n", parts_->linear.reason);
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
