/// The analyses this package offers.
#pragma once

#include <culm/analysis/stepper.hpp>
#include <culm/base/registry.hpp>

#include <memory>
#include <set>
#include <string>

namespace culm::analysis {

/// The types of analyses by their names in the deck, and what other parts of a deck rely on.
struct AnalysisRegistry {
  Registry<std::unique_ptr<Stepper>, Context&, model::State&> steppers;  ///< they move the state
  Registry<std::unique_ptr<Inspection>> inspections;
  std::set<std::string> gives_shapes;  ///< that imperfections may take
  /// Whose level may fall, and leave the range from 0 to 1, where 'Ramp' goes on then.
  std::set<std::string> follows_path;

  /// The schemas of all, by type name.
  Variants variants() const;
};

void register_analyses(AnalysisRegistry& registry);

}  // namespace culm::analysis
