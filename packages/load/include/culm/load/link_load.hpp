/// Springs, dampers and drives on nodes and between them.
#pragma once

#include <culm/load/link.hpp>
#include <culm/load/link_law.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/item_motion.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::load {

struct MeasureStep;

/// Links that answer to one law. With the forms y(q) of a link and the discrete gradient G of its
/// coordinate u(y), the force on the slots is
///   f = B(q_theta)^T G F      B = dy/dq      G . Dy = Du
/// so that f . Dq = F Du exactly; where F = DW / Du that is the change of the stored energy.
/// Forms between two nodes do not change under rigid motion, so f keeps the momenta.
/// @source formulation 0.3, 3.6, 4.4
class LinkLoad final : public model::Batch, public model::Booked {
 public:
  LinkLoad(model::Effect effect, const model::NodeTable& nodes, std::unique_ptr<LinkLaw> law)
      : effect_(std::move(effect)), nodes_(nodes), law_(std::move(law)) {}

  void add(Link link);

  const model::Effect& effect() const override { return effect_; }
  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  void place(model::Placement placement, model::Form form) override;
  void prepare(const model::State& state, const Stencil& stencil) override;
  void accept(model::State& state) override;
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void extrapolate(const model::State& state, const Stencil& stencil,
                   const model::Coordinates& increment) override;
  std::size_t memory_size() const override { return item_memory * items_.size(); }
  void save(model::Items which, std::span<double> memory) const override;
  void restore(std::span<const double> memory) override;
  void forget_evaluation() override;
  double stored_energy(const model::Coordinates& q) const override;
  /// The coordinate u of an item [m, rad] at a state, and the force that resisted it in the last
  /// step [N, N m]; of the state itself before the first. Zero on ranks that do not own the item.
  struct Sample {
    double coordinate = 0.0;
    double force = 0.0;
  };
  Sample sample(int item, const model::State& state) const;
  const Link& link(int item) const { return items_[static_cast<std::size_t>(item)].link; }

  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  static constexpr std::size_t item_memory = 3;  ///< forms and coordinate

  using Motion = model::ItemMotion<2>;
  /// Where a link is: the two forms, and the coordinate with all full turns.
  struct Place {
    Vec<2> y = Vec<2>::Zero();
    double z = 0.0;
  };
  struct Item {
    Link link;
    bool is_internal = false;  ///< forces keep the momenta of what it acts on
    Place accepted;            ///< at the end of the last accepted step
    Place prev;                ///< at the start of the step, which is where a motion begins, too
    Vec<2> predicted_stress = Vec<2>::Zero();
    std::optional<double> force;    ///< of the last evaluation
    std::optional<double> reached;  ///< coordinate at its end, if that was in this step
  };
  /// S = G F and its derivative by the forms at the end of the step.
  struct Response {
    Vec<2> stress;
    Mat<2, 2> tangent;
    Vec<2> by_signal;  ///< derivative of the stress by the signal of the law
    double force = 0.0;
    double reached = 0.0;  ///< coordinate at the end of the step
  };

  /// Where the link is at forms y, not more than half a turn from `from`.
  static Place follow(const Item& item, const Place& from, const Vec<2>& y);
  Response respond(const Item& item, const Motion::Slots& next, const model::State& state,
                   const Stencil& stencil) const;
  /// Where a step begins and ends without length. @param slope  of the law
  static Response next_to_no_length(Measure measure, double slope, const MeasureStep& step);
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target);
  template <class Space>
  void add_tangent(std::size_t i, const Motion& motion, const Response& response, double theta,
                   model::Target& target) const;

  Item& item(std::size_t i) { return items_[static_cast<std::size_t>(placement_.items[i])]; }
  const Item& item(std::size_t i) const {
    return items_[static_cast<std::size_t>(placement_.items[i])];
  }

  model::Effect effect_;
  const model::NodeTable& nodes_;
  std::unique_ptr<LinkLaw> law_;
  std::vector<Item> items_;
  model::Placement placement_;
  model::Form form_ = model::Form::null_space;
  bool use_predicted_ = false;
};

}  // namespace culm::load
