#include <culm/base/error.hpp>
#include <culm/base/version.hpp>
#include <culm/deck/resolved.hpp>
#include <culm/simulation/simulation.hpp>

#include "model_builder.hpp"
#include "model_report.hpp"
#include "run_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace culm::simulation {

struct Simulation::Parts {
  parallel::Comm comm;
  const Catalogue& catalogue;
  Options deck;
  Log log;
  Ledger ledger;
  model::Model model;
  std::vector<WatchedQuantity> watched;
  std::unique_ptr<assembly::System> system;
  solver::ChosenSolver linear;
};

Simulation::Simulation(const parallel::Comm& comm, const Catalogue& catalogue, const Options& deck,
                       const Log& log)
    : parts_(new Parts{comm, catalogue, deck, log, {}, {}, {}, {}, {}}) {
  Parts& p = *parts_;
  p.watched = build_model(catalogue, deck, log, p.model);
  p.system = std::make_unique<assembly::System>(p.model, comm, p.ledger);
  p.linear = solver::choose_linear_solver(deck.list("Solver").text("Linear Solver"),
                                          p.system->matrix(), comm);
}

Simulation::~Simulation() = default;

void Simulation::run(const RunSettings& settings) {
  Parts& p = *parts_;
  const Options& output = p.deck.list("Output");
  ResultFiles files(*p.system,
                    {settings.folder,
                     {p.deck.text("Title"), std::string(version), deck::resolved(p.deck)},
                     output.integer("Every"),
                     output.flag("Pictures")},
                    p.watched);
  const Ledger::Id output_effect = p.ledger.add("Output");
  RunObserver observer(*p.system, files, p.ledger, output_effect, p.linear.reason,
                       Progress(p.log, settings.quiet, settings.terminal));
  analysis::Context context{*p.system, *p.linear.solver, p.ledger, p.log};
  model::State state = p.model.initial_state();
  observer.start(state);
  try {
    for (const Options& entry : p.deck.list("Analyses").entries()) {
      observer.begin(entry.name());
      const auto analysis = p.catalogue.analyses.make(entry.text("Type"), entry);
      observer.finish_analysis(analysis->run(context, state, observer));
    }
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
