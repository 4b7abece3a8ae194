/// Contact of round beams with each other.
#pragma once

#include <culm/contact/contact_point.hpp>
#include <culm/contact/line_element.hpp>
#include <culm/contact/repulsion.hpp>
#include <culm/contact/sliding.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::contact {

/// Two lines whose points repel each other where the axes are nearer than the sum of their radii.
/// The energy of a pair is a function of r . r, r between both points, which no rigid motion
/// changes; the force on the slots is the mean derivative of a step times its gradient at theta: a
/// conserving step keeps energy and momenta, wherever beams cross or lie along each other. Friction
/// acts where both surfaces meet; in statics there is none.
/// An item is an element of one line with one of the other, so the graph holds all pairs that may
/// ever touch.
class BeamContact final : public model::MemorylessBatch, public Contact, public model::Booked {
 public:
  static constexpr int max_nodes = 8;

  /// @param width  twice the radius of the first line [m]
  BeamContact(model::Effect effect, const model::NodeTable& nodes, const Repulsion& law,
              const Friction& friction, double width, std::vector<LineElement> first,
              std::vector<LineElement> second);

  Touch touch(const model::Coordinates& q) const override;
  std::string objection(const model::Coordinates& q) const override;
  std::string left_out_at_rest() const override;
  int size() const override { return static_cast<int>(first_.size() * second_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  /// law_out_of_range where axes come nearer than half of the reach within the step: beams may not
  /// pass through each other.
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  struct Pair;

  const LineElement& first_of(int item) const {
    return first_[static_cast<std::size_t>(item) / second_.size()];
  }
  const LineElement& second_of(int item) const {
    return second_[static_cast<std::size_t>(item) % second_.size()];
  }
  bool is_apart(int item, const model::Coordinates& prev, const model::Coordinates& next) const;
  template <class Act>
  Verdict visit_pairs(int item, const model::Coordinates& prev, const model::Coordinates& next,
                      Act act) const;
  /// Nothing where there is none.
  std::optional<Sliding> friction_of(int item, const Pair& pair, const RepulsionResponse& response,
                                     const model::State& state, const Stencil& stencil,
                                     bool tangent) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target);

  const model::NodeTable& nodes_;
  Repulsion law_;
  Friction friction_;
  double width_;
  std::vector<LineElement> first_, second_;
  std::vector<std::vector<int>> nodes_of_;  ///< by item: those of the first line, then the others
  /// Places of the points of the second element of an item at both ends of a step.
  mutable std::vector<std::pair<Vec3, Vec3>> places_;
};

}  // namespace culm::contact
