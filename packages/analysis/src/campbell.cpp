#include <culm/analysis/campbell.hpp>
#include <culm/analysis/modal.hpp>
#include <culm/analysis/newton_options.hpp>

#include "levels.hpp"
#include "mode_diagram.hpp"

#include <algorithm>

namespace culm::analysis {

Schema Campbell::schema() {
  Schema schema("Campbell",
                "Equilibrium and modes at several load levels, modes followed by their shapes: the "
                "Campbell diagram of a model with a rotating frame.");
  add_levels(schema,
             "Load levels, rising; the speed of a rotating frame grows with them by its function.");
  return add_modal_fields(schema).list("Newton", newton_schema(), Presence::defaulted);
}

std::unique_ptr<Inspection> Campbell::make(const Options& options) {
  return std::make_unique<Campbell>(CampbellSettings{options.numbers("Levels"),
                                                     read_modal_settings(options),
                                                     newton_settings(options.list("Newton"))});
}

AnalysisReport Campbell::inspect(Context& context, model::State& state) {
  const Ledger::Scope scope(context.ledger, context.ledger.add("Campbell"));
  ModeDiagram diagram(context, settings_.modes, settings_.newton, "campbell");
  state.time = state.time_prev = std::min(state.time, settings_.levels.front());
  for (double level : settings_.levels) diagram.add(state, diagram.find(state, level));
  AnalysisReport report;
  report.text = diagram.text();
  report.tables.push_back(diagram.table());
  return report;
}

}  // namespace culm::analysis
