// What a simulation says of its model before it runs.

#include <culm/analysis/dynamics.hpp>
#include <culm/simulation/simulation.hpp>
#include <culm/solver/fill.hpp>

#include "model_report.hpp"
#include "simulation_parts.hpp"

#include <fmt/format.h>

namespace culm::simulation {
namespace {

// Of a factorisation that is worth a look at the start: some seconds.
constexpr double most_operations = 2e10;

// Factors are predicted as those of the solver that fits the model best, or of the iterative one.
std::string named_solver(const Options& deck, const Phase& phase) {
  const std::string& name = deck.list("Solver").text("Linear Solver");
  if (name == "Automatic" || phase.linear.is_iterative) return {};
  return fmt::format("; factors are those that 'Automatic' would take, '{}' may take more", name);
}

// Layers, and factors that nobody shares, are on rank 0.
std::string of_each(const model::MemoryNeed& need, bool shares_factors,
                    const model::Processes& processes) {
  if (processes.all == 1) return {};
  const double shared = need.elements + need.modes + (shares_factors ? need.factors : 0.0);
  const double most = need.total() - shared + shared / processes.here;
  return fmt::format(" on a machine with {} of {} processes, up to {:.3g} GB in one",
                     processes.here, processes.all, 1e-9 * most);
}

}  // namespace

void Simulation::examine() {
  Parts& p = *parts_;
  p.phases.refuse_late_starts();
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

std::string Simulation::summary() const {
  const Phase& phase = parts_->phases.of(0);
  model::MemoryNeed need = phase.need;
  need.factors = factors_by_graph(phase, parts_->comm, parts_->processes);
  const model::Model& model = *phase.model;
  const auto entries = phase.system->matrix()->total_entries();
  std::string text = report_masses(model) + '\n';
  if (const std::string constraints = report_constraints(model); !constraints.empty()) {
    text += constraints + '\n';
  }
  text += report_unknowns(model) + fmt::format("matrix entries: {}\n", entries);
  text += fmt::format("linear solver: {}\n", phase.linear.reason);
  text += fmt::format("memory, predicted: {}{}{}\n\n", need.text(),
                      of_each(need, phase.linear.is_shared, parts_->processes),
                      named_solver(parts_->deck, phase));
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
