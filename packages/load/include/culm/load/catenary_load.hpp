/// Mooring lines as loads: catenaries at rest between a fixed anchor and a point of a node.
#pragma once

#include <culm/load/catenary.hpp>
#include <culm/load/link.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/item_motion.hpp>
#include <culm/model/memoryless_batch.hpp>

#include <vector>

namespace culm::load {

/// Lines that have neither inertia nor drag. Their energy W is a function of the forms
///   y = (|p|^2 / L^2, e . p / L)      p from the anchor to the fairlead, e upwards
/// and the force on the slots is f = -B(q_theta)^T G, with G . Dy = DW in the conserving step, so
/// that a step keeps the energy, and the angular momentum about the vertical through the anchor.
/// What friction on the seabed changes of it has no potential, so it is external work.
class CatenaryLoad final : public model::MemorylessBatch, public model::Booked {
 public:
  CatenaryLoad(model::Effect effect, const model::NodeTable& nodes)
      : MemorylessBatch(std::move(effect)), nodes_(nodes) {}

  /// @param up  unit vector against gravity
  void add(const LinkPoint& fairlead, const Vec3& anchor, const Vec3& up, const CatenaryLine& line);

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;
  const CatenaryLine& line(int item) const { return items_[static_cast<std::size_t>(item)].line; }
  /// The forms, of the place over the length of the line.
  const Link& link(int item) const { return items_[static_cast<std::size_t>(item)].forms; }
  /// The line of an item with the fairlead where it is at q.
  CatenaryEnds ends(int item, const model::Coordinates& q) const;

 private:
  struct Item {
    Link forms;
    CatenaryLine line;
  };
  /// Derivative of W by the forms in a step, what friction adds to it, and the derivative of their
  /// sum by the forms of the end.
  struct Response {
    Vec<2> stress = Vec<2>::Zero();
    Vec<2> friction = Vec<2>::Zero();
    Mat<2, 2> tangent = Mat<2, 2>::Zero();

    Vec<2> sum() const { return stress + friction; }
  };

  Response respond(const Item& item, const model::State& state, const Stencil& stencil) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const Item& local(std::size_t i) const {
    return items_[static_cast<std::size_t>(placement().items[i])];
  }

  const model::NodeTable& nodes_;
  std::vector<Item> items_;
};

}  // namespace culm::load
