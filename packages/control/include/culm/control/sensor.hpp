/// What controls measure of the motion of nodes.
#pragma once

#include <culm/control/register_control.hpp>
#include <culm/joint/axis_turn.hpp>
#include <culm/model/memoryless_batch.hpp>

#include <string>
#include <vector>

namespace culm::control {

/// What of a node is measured.
enum class Measured {
  angular_velocity,  ///< about an axis [rad/s]
  velocity,          ///< of the position, along a direction [m/s]
  displacement,      ///< from the reference, along a direction [m]
};

/// Algebraic signals s = sum_a +- m_a of one node, or of one relative to another: mean velocities
/// of the step, an angular velocity 2 atan(n . tau / 2) / h with the Cayley vector tau of the step,
/// and displacements in its middle. In statics velocities are zero and displacements those of the
/// end.
/// @source formulation 2.4, 3.1
class SensorBatch final : public model::MemorylessBatch {
 public:
  SensorBatch(model::Effect effect, model::Model& model)
      : MemorylessBatch(std::move(effect)), model_(model) {}

  /// A node and the direction there, of unit length.
  struct Place {
    int node = -1;
    joint::TurnAxis axis;  ///< only of angular velocities does it follow
  };
  /// @param places  one, or another one that the first is measured against
  model::Signal add(const std::string& name, Measured measured, std::vector<Place> places,
                    double scale);

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State&, const Stencil&) const override { return {}; }

 private:
  struct Item {
    Measured measured;
    std::vector<Place> places;
    model::Signal signal;
  };
  /// A measured value and its derivative by the unknowns of a node at the end of the step.
  template <class Space>
  struct Reading {
    double value = 0.0;
    Vec<Space::width> gradient = Vec<Space::width>::Zero();
  };
  template <class Space>
  Reading<Space> read(Measured measured, const Place& place, const model::State& state,
                      const Stencil& stencil) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  model::Model& model_;
  std::vector<Item> items_;
};

/// Angular Velocity, Angular Velocity Local, Velocity, Displacement
void register_sensors(SignalRegistry& registry);

}  // namespace culm::control
