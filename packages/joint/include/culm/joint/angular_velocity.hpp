/// Prescribed angular velocities.
#pragma once

#include <culm/joint/axis_turn.hpp>
#include <culm/joint/prescribed.hpp>
#include <culm/model/build_context.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/reaction_source.hpp>

#include <string>
#include <utility>
#include <vector>

namespace culm::joint {

/// Turns nodes about an axis with the angular velocity Omega(t). Nonholonomic: the row holds for
/// the turn of a step,
///   n . tau - 2 tan( alpha / 2 ) = 0,  alpha = integral of Omega over the step,
/// force: moment lambda n, so the angle after any number of steps is the integral of Omega (of a
/// signal the sum of dt Omega_1/2), and the drive does the work -lambda n . tau. Statics knows no
/// velocity: the row is lambda = 0 there.
/// @source formulation 2.4
class AngularVelocity final : public model::MemorylessBatch, public model::ReactionSource {
 public:
  /// @param model gets an unknown for each item
  AngularVelocity(model::Effect effect, model::Model& model)
      : MemorylessBatch(std::move(effect)), model_(model) {}

  /// What an item says to those who ask the model for its constraints.
  /// @param axis in the reference, unit length
  static model::Constraint constraint(std::string name, const std::string& type,
                                      const model::NodeTable& nodes, int node, const Vec3& axis);
  /// @param constraint  name by which its moment is asked for
  void add(int node, const TurnAxis& axis, const Prescribed& velocity, std::string constraint);

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;
  /// The moment -lambda n of the drive, with the axis at the end of the step.
  Vec6 reaction(int node, const model::State& state, const std::string& constraint) const override;

 private:
  struct Item {
    int node = -1;
    TurnAxis axis;
    Prescribed velocity;  ///< Omega [rad/s]
    std::string constraint;
    model::Signal moment;  ///< lambda [N m]
  };

  void assemble_rest(std::size_t i, const model::State& state, Want want,
                     model::Target& target) const;
  template <class Space>
  Verdict assemble_border(std::size_t i, const model::State& state, model::Target& target) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil, Want want,
                        model::Target& target) const;

  model::Model& model_;
  std::vector<Item> items_;
};

/// Angular Velocity, Angular Velocity Local
void register_angular_velocity(model::BuilderRegistry& registry);

}  // namespace culm::joint
