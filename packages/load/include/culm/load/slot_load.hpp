/// Forces on slots that are constant or linear in the slots.
#pragma once

#include <culm/load/axes.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/dead_weight.hpp>
#include <culm/model/local_items.hpp>
#include <culm/model/projection.hpp>
#include <culm/model/structure.hpp>

#include <optional>
#include <string>
#include <vector>

namespace culm::load {

/// External forces on the slots of one to four nodes, a(t) times
///   f_s = f0_s + sum_t L[s,t] q_t,theta.
/// Points are linear in the slots, so a dead force F at a point is f0_s = T_s F, and a force
/// F_k d_k that follows the directors is L = T D^T with D the slot factors of F_k d_k. Both are
/// taken at q_theta, so the work of dead forces over a step is exact. @source formulation 3, 3.2
class SlotLoad final : public model::Batch, public model::Booked, public model::DeadWeight {
 public:
  static constexpr int max_nodes = 4;

  SlotLoad(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude)
      : effect_(std::move(effect)), nodes_(nodes), amplitude_(std::move(amplitude)) {}

  /// Adds a force at a material point. Points that follow each other on the same nodes share an
  /// item. @param components  of the force [N], or of its share of a force per length
  void add_force(const model::Marker& point, const Vec3& components, Axes axes);
  /// Adds constant forces on the slots of a node, shape (3, 4) [N, N m].
  void add_slot_forces(int node, const model::NodeSlots& forces);
  /// Adds a force in space on a node that set_force changes, zero before. @return item
  int add_settable_force(int node);
  void set_force(int item, const Vec3& force);

  const model::Effect& effect() const override { return effect_; }
  int size() const override { return items_.size(); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  /// Only forces that follow, or that have an arm about a node, change with its rotation.
  bool has_tangent() const override;
  void place(model::Placement placement, model::Form form) override;
  void forget_others() override { items_.keep(placement_.items); }
  void prepare(const model::State&, const Stencil&) override {}  // nothing is kept
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void extrapolate(const model::State&, const Stencil&, const model::Coordinates&) override {}
  /// -f . q of loads that are constant in time and space, otherwise zero.
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;
  bool has_potential() const override;

 private:
  struct Item {
    std::vector<int> nodes;
    Eigen::Matrix3Xd constant;  // f0, shape (3, slots)
    Eigen::MatrixXd linear;     // L, shape (slots, slots); empty if nothing follows
    bool follows = false;       // L is not zero
    bool is_settable = false;   // f0 may become another one
  };

  // A local item with constant forces on one node, which is no slave.
  struct Free {
    int local;
    int node;
    int row;            // of the force, where it turns nothing and meets no support; else -1
    bool turns;         // its directors turn with it
    bool on_directors;  // some forces act there
    Vec3 force;         // on its position
  };

  Item& item_on(const std::vector<int>& nodes);
  // The i-th of those that this rank evaluates.
  const Item& local(std::size_t i) const { return items_.local(placement_.items, i); }
  bool turns(const Item& item) const;
  bool is_free(const Item& item) const;
  Eigen::Map<const model::NodeSlots> forces_of(const Free& item) const;
  Verdict assemble_free(const Free& item, const model::State& state, const Stencil& stencil,
                        double factor, bool tangent, model::Target& target) const;
  void add_push(const Free& item, const model::State& state, double theta, double factor,
                model::StepWork& work) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        double factor, bool tangent, model::Target& target) const;

  model::Effect effect_;
  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  model::LocalItems<Item> items_;
  bool follows_ = false;  ///< some item does
  model::Placement placement_;
  model::Form form_ = model::Form::null_space;
  std::optional<bool> has_tangent_;  ///< once placed
  std::vector<Free> free_;
  double largest_dead_ = 0.0;        // component of a force with a row
  std::vector<std::size_t> others_;  // local items
};

}  // namespace culm::load
