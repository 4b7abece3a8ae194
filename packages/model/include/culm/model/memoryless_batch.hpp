/// What batches share that keep nothing from step to step.
#pragma once

#include <culm/model/batch.hpp>
#include <culm/model/node_table.hpp>
#include <culm/model/projection.hpp>

#include <string>
#include <utility>
#include <vector>

namespace culm::model {

/// A batch of items that remember nothing, extrapolate nothing and store no energy, such as
/// moments, pressures and dampers. Derived classes hold the items and say what each one adds.
class MemorylessBatch : public Batch {
 public:
  const Effect& effect() const override { return effect_; }
  void place(Placement placement, Form form) override {
    placement_ = std::move(placement);
    form_ = form;
  }
  void prepare(const State&, const Stencil&) override {}
  void extrapolate(const State&, const Stencil&, const Coordinates&) override {}
  double stored_energy(const Coordinates&) const override { return 0.0; }

 protected:
  explicit MemorylessBatch(Effect effect) : effect_(std::move(effect)) {}

  const Placement& placement() const { return placement_; }
  /// Until placed, the form with more entries.
  Form form() const { return form_; }

  /// Calls assemble(space, i) for all local items i, with a NullSpace or a FullSpace, and joins the
  /// verdicts.
  template <class Assemble>
  Verdict assemble_items(Assemble assemble) const {
    Verdict verdict = Verdict::ok;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      verdict = worse(
          verdict, form_ == Form::null_space ? assemble(NullSpace{}, i) : assemble(FullSpace{}, i));
    }
    return verdict;
  }

  static std::vector<int> blocks_of(const std::vector<int>& nodes, const UnknownTable& unknowns) {
    std::vector<int> blocks;
    for (int node : nodes) blocks.push_back(unknowns.node_block(node));
    return blocks;
  }

 private:
  Effect effect_;
  Placement placement_;
  Form form_ = Form::multipliers;
};

}  // namespace culm::model
