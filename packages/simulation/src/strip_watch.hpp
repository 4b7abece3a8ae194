/// Finds loads of air that count it twice, or that no wind reaches.
#pragma once

#include <culm/base/findings.hpp>
#include <culm/model/model.hpp>
#include <culm/strip/strip_load.hpp>

#include <utility>
#include <vector>

namespace culm::simulation {

/// Looks at pairs of strips on the same chord, of which a deck refuses those that always act.
/// Others have functions of time and may take turns: whether they do is seen step by step. And at
/// strips and lattices that stand below the ground of a wind that grows with the height, with all
/// of their stations or points. And at lattices that lift the nodes of strips or other lattices.
class StripWatch {
 public:
  /// Starts anew with the loads of a model, which must outlive this.
  void begin(const model::Model& model);
  /// After an accepted step, or where an analysis looks at a state. Costs nothing without any.
  void step(const model::State& state, Findings& findings) const;

 private:
  std::vector<std::pair<const strip::StripLoad*, const strip::StripLoad*>> pairs_;
  std::vector<const model::Batch*> below_ground_;
  std::vector<std::pair<const model::Batch*, const model::Batch*>> same_nodes_;
};

}  // namespace culm::simulation
