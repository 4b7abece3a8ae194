/// Forces on a node that are linear in its motion from the reference.
#pragma once

#include <culm/load/small_motion.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>

#include <string>
#include <utility>
#include <vector>

namespace culm::load {

/// F = P - C x - B v - Q |v| v with the motion x of a node, v its mean rate in a step, |v| v
/// component by component. With C symmetric a conserving step keeps the energy 1/2 x C x - P x
/// exactly; what B and Q take is booked. In statics nothing is damped.
class RestoringLoad final : public model::MemorylessBatch,
                            public model::LimitedRange,
                            public model::Booked {
 public:
  struct Values {
    Vec6 preload = Vec6::Zero();
    Mat6 stiffness = Mat6::Zero(), damping = Mat6::Zero(), quadratic = Mat6::Zero();
  };

  RestoringLoad(model::Effect effect, const model::NodeTable& nodes, const Values& values)
      : MemorylessBatch(std::move(effect)), nodes_(nodes), values_(values) {}

  void add(int node) { items_.push_back({nodes_, node}); }

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;
  double range_used() const override;
  std::string range_warning(double used) const override;

 private:
  struct Evaluation {
    Vec6 force = Vec6::Zero(), damping = Vec6::Zero();  // the second is part of the first
    Mat6 derivative = Mat6::Zero();                     // by the motion at the end of the step
  };

  Evaluation evaluate(const SmallMotion& motion, const model::State& state,
                      const Stencil& stencil) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil, Want want,
                        model::Target& target) const;
  const SmallMotion& local(std::size_t i) const {
    return items_[static_cast<std::size_t>(placement().items[i])];
  }

  const model::NodeTable& nodes_;
  Values values_;
  std::vector<SmallMotion> items_;
  double largest_turn_ = 0.0;
};

}  // namespace culm::load
