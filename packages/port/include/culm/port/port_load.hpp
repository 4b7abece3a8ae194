/// Forces and moments on material points, set from step to step.
#pragma once

#include <culm/model/item_motion.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/structure.hpp>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace culm::port {

/// Forces f and moments m in space at points X = sum_s T_s q_s, by the transpose of the map by
/// which the points move: on the slots
///   f_s = T_s f      f_d_i,a = N_a (J m) x d_i,theta
/// with d_i = sum_a N_a d_i,a and J of load::Couple. Their work over a step is f . DX + m . tau,
/// their resultant and moment about the origin those of the points at q_theta, exactly. All points
/// on the same nodes are one item. Before the first set there are no loads. @source formulation 3
class PortLoad final : public model::MemorylessBatch {
 public:
  static constexpr int max_nodes = 4;

  /// @param points  of at most max_nodes nodes each
  PortLoad(model::Effect effect, const model::NodeTable& nodes, std::vector<model::Marker> points);

  const std::vector<model::Marker>& points() const { return points_; }
  /// What acts from now on. @param forces, moments  one per point [N, N m]
  void set(std::span<const Vec3> forces, std::span<const Vec3> moments);
  /// Whether anything does.
  bool is_loaded() const {
    return std::ranges::any_of(items_, [](const Item& item) { return item.is_loaded; });
  }

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  using Motion = model::ItemMotion<max_nodes>;
  using SlotForces = Motion::Slots;
  struct Item {
    std::vector<int> nodes;
    std::vector<std::size_t> points;
    NodeKind kind = NodeKind::node12;
    SlotForces forces;       // of the forces of all points, shape (3, 4 nodes)
    bool is_loaded = false;  // by anything
    bool has_moments = false;
  };

  SlotForces slot_forces(const Item& item, const Motion& motion) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  std::vector<model::Marker> points_;
  std::vector<Vec3> moments_;
  std::vector<Item> items_;
};

}  // namespace culm::port
