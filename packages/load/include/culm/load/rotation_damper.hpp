/// Dampers on the rotation of nodes.
#pragma once

#include <culm/joint/axis_turn.hpp>
#include <culm/load/piecewise_linear.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>

#include <string>
#include <utility>
#include <vector>

namespace culm::load {

/// Moments -F(omega_n) n on nodes with omega_n = n . tau / dt, tau the Cayley vector of the step:
/// they take F omega_n dt >= 0 exactly, and are not there in statics.
/// @source formulation 3.1, 3.6
class RotationDamper final : public model::MemorylessBatch, public model::Booked {
 public:
  /// @param moment F, with the sign of omega_n
  RotationDamper(model::Effect effect, const model::NodeTable& nodes, PiecewiseLinear moment)
      : MemorylessBatch(std::move(effect)), nodes_(nodes), moment_(std::move(moment)) {}

  void add(int node, const joint::TurnAxis& axis) { items_.push_back({node, axis}); }

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  struct Item {
    int node = -1;
    joint::TurnAxis axis;
  };
  template <class Space>
  joint::AxisTurn<Space> turn_of(std::size_t i, const model::State& state,
                                 const Stencil& stencil) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  PiecewiseLinear moment_;
  std::vector<Item> items_;
};

}  // namespace culm::load
