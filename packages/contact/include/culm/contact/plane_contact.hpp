/// Contact of lines and bodies with a fixed plane.
#pragma once

#include <culm/contact/contact_point.hpp>
#include <culm/contact/friction.hpp>
#include <culm/contact/gripping_batch.hpp>
#include <culm/contact/penalty.hpp>
#include <culm/model/booked.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace culm::contact {

/// A plane with the structure on the side of its normal.
struct Plane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit vector
};

/// Points x = sum_s T_s q_s with the depth r - n . (x - p). The pressure acts at the point along n,
/// so that its work is the difference of its energy; friction acts where the surface touches,
///   x_c = x + sum_i xi_i d_i,   xi_i = -r n . d_i   in the middle of the step,
/// against the velocity Dx_c / step of this material point, so that it only takes energy. In
/// statics this point sticks, by the stiffness of the pressure, until it slides.
/// @source fluids B8
class PlaneContact final : public GrippingBatch, public Contact, public model::Booked {
 public:
  static constexpr int max_nodes = 4;

  PlaneContact(model::Effect effect, const model::NodeTable& nodes, Plane plane,
               const Penalty& penalty, const Friction& friction)
      : GrippingBatch(std::move(effect)),
        Booked("contact"),
        nodes_(nodes),
        plane_(std::move(plane)),
        penalty_(penalty),
        friction_(friction) {}

  void add(ContactPoint point) {
    points_.push_back(std::move(point));
    if (friction_.coefficient > 0.0) add_grip();
  }

  Touch touch(const model::Coordinates& q) const override;

  int size() const override { return static_cast<int>(points_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  struct Evaluation;
  double depth(const ContactPoint& point, const model::Coordinates& q) const;
  Evaluation evaluate(int item, const model::State& state, const Stencil& stencil) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const ContactPoint& point(int item) const { return points_[static_cast<std::size_t>(item)]; }

  const model::NodeTable& nodes_;
  Plane plane_;
  Penalty penalty_;
  Friction friction_;
  std::vector<ContactPoint> points_;
};

}  // namespace culm::contact
