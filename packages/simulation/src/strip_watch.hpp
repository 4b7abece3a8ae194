/// Finds strips that count the air twice.
#pragma once

#include <culm/base/findings.hpp>
#include <culm/model/model.hpp>
#include <culm/strip/strip_load.hpp>

#include <utility>
#include <vector>

namespace culm::simulation {

/// Looks at pairs of strips on the same chord, of which a deck refuses those that always act.
/// Others have functions of time and may take turns: whether they do is seen step by step.
class StripWatch {
 public:
  /// Starts anew with the loads of a model, which must outlive this.
  void begin(const model::Model& model);
  /// After an accepted step, or where an analysis looks at a state. Costs nothing without such
  /// pairs.
  void step(const model::State& state, Findings& findings) const;

 private:
  std::vector<std::pair<const strip::StripLoad*, const strip::StripLoad*>> pairs_;
};

}  // namespace culm::simulation
