/// Nodes with mass but without stiffness: rigid bodies and point masses.
#pragma once

#include <culm/mechanics/mass_pack.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/node_table.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace culm::model {

/// Constant scalar mass matrices on the slots (x, d1, d2, d3) of single nodes,
/// [[m, S^T], [S, J]] with the Euler tensor J. @source formulation 1.2, eq. (1.1)
class MassBatch final : public Batch, public MassSource {
 public:
  MassBatch(Effect effect, const NodeTable& nodes) : effect_(std::move(effect)), nodes_(nodes) {}

  /// @param mass symmetric positive semidefinite [kg, kg m, kg m^2]
  void add(int node, const SlotMatrix<4>& mass) { items_.push_back({node, mass}); }

  const Effect& effect() const override { return effect_; }
  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  void place(Placement placement, Form form) override;
  void prepare(const State&, const Stencil&) override {}  // nothing is kept
  Verdict assemble(const State& state, const Stencil& stencil, Want want, Target& target) override;
  void extrapolate(const State&, const Stencil&, const Coordinates&) override {}  // no stress
  double stored_energy(const Coordinates&) const override { return 0.0; }
  StepWork step_work(const State&, const Stencil&) const override { return {}; }
  void add_mass_times(const Coordinates& acceleration, Coordinates& force) const override;
  void visit_masses(const MassVisitor& visit) const override;
  double kinetic_energy(const Coordinates& velocity) const override;
  void add_momentum(const Coordinates& q, const Coordinates& velocity,
                    Momentum& momentum) const override;

 private:
  struct Item {
    int node = -1;
    SlotMatrix<4> mass;
  };

  // Items that are evaluated at once; the last one is repeated.
  struct Together {
    MassPack masses;
    std::array<std::size_t, pack_lanes> items;  // of the placement
    int count = 0;
  };

  const Item& local(std::size_t i) const {
    return items_[static_cast<std::size_t>(placement_.items[i])];
  }
  void add_to_packs(std::size_t i);
  Verdict assemble_pack(const Together& pack, const State& state, const Stencil& stencil, Want want,
                        Target& target) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const State& state, const Stencil& stencil, Want want,
                        Target& target) const;

  Effect effect_;
  const NodeTable& nodes_;
  std::vector<Item> items_;
  Placement placement_;
  Form form_ = Form::null_space;
  std::vector<Together> packs_;
  std::vector<std::size_t> alone_;  // items of the placement in no pack
};

}  // namespace culm::model
