/// Signals that keep a value for a step.
#pragma once

#include <culm/model/memoryless_batch.hpp>
#include <culm/model/model.hpp>

#include <string>
#include <utility>
#include <vector>

namespace culm::control {

/// Signals with values that somebody finds in an accepted state and that stay what they are in the
/// next step, x = x_prev: one step late, and no part of the tangent.
class SampleBatch final : public model::MemorylessBatch {
 public:
  SampleBatch(model::Effect effect, model::Model& model)
      : MemorylessBatch(std::move(effect)), model_(model) {}

  /// @return the signal; its value is written into State::own and State::own_prev
  model::Signal add(const std::string& name, double initial);

  int size() const override { return static_cast<int>(signals_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State&, const Stencil&) const override { return {}; }

 private:
  model::Model& model_;
  std::vector<model::Signal> signals_;
};

}  // namespace culm::control
