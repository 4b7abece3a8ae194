/// Forces per length that a field gives.
#pragma once

#include <culm/model/amplitude.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/structure.hpp>
#include <culm/model/vector_field.hpp>

#include <string>
#include <utility>
#include <vector>

namespace culm::load {

/// Forces a(t) l f(x, t) at points of lines with the length l, where f is a field at the place of
/// the point: on the slots
///   f_s = T_s a l f(x_theta, t_theta)     x = sum_s T_s q_s,
/// so that the force does the work f . Dx over a step. @source formulation 3, 3.7
class FieldLoad final : public model::MemorylessBatch, public model::Booked {
 public:
  static constexpr int max_nodes = 4;

  FieldLoad(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude,
            model::SharedField field)
      : MemorylessBatch(std::move(effect)),
        nodes_(nodes),
        amplitude_(std::move(amplitude)),
        field_(std::move(field)) {}

  /// @param factor  on the field, with the length of the line that the point stands for
  void add(const model::Marker& point, double factor) { items_.push_back({point, factor}); }

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  struct Item {
    model::Marker point;
    double factor = 0.0;
  };
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  model::SharedField field_;
  std::vector<Item> items_;
};

}  // namespace culm::load
