/// Contact of lines and bodies with cylinders on bodies or in space.
#pragma once

#include <culm/contact/contact_point.hpp>
#include <culm/contact/friction.hpp>
#include <culm/contact/gripping_batch.hpp>
#include <culm/contact/penalty.hpp>
#include <culm/contact/sliding.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/item_motion.hpp>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::contact {

/// A round bar about the axis from a to b, with half spheres at its ends or without ends.
struct Cylinder {
  int node = -1;                 ///< that it moves with; -1: fixed in space
  Vec3 a = Vec3::Zero();         ///< in the directors of the node, or in space [m]
  Vec3 along = Vec3::Zero();     ///< unit vector from a to b, likewise
  std::optional<double> length;  ///< of the axis; without ends if none [m]
  double radius = 0.0;           ///< [m]
};

/// Points against a cylinder. With r from a to a point and the unit vector e of
/// the axis, the distance D is a function of two quadratic forms that no rigid motion changes,
///   y1 = r . r, y2 = r . e     D^2 = y1 - 2 c y2 + c^2, c the nearest place on the axis,
/// whose differences obey DD = G . Dy with G = (1, -2 cm) / (D_n + D_n+1), cm the mean of c over
/// the step. The force on the slots is the pressure of the step times G through the gradient of y
/// at theta: a conserving step keeps energy and momenta. Friction acts where both surfaces meet; in
/// statics they stick there, by the stiffness of the pressure, until they slide.
class CylinderContact final : public GrippingBatch, public Contact, public model::Booked {
 public:
  static constexpr int max_nodes = 5;

  CylinderContact(model::Effect effect, const model::NodeTable& nodes, const Cylinder& cylinder,
                  const Penalty& penalty, const Friction& friction)
      : GrippingBatch(std::move(effect)),
        Booked("contact"),
        nodes_(nodes),
        cylinder_(cylinder),
        penalty_(penalty),
        friction_(friction) {}

  void add(const ContactPoint& point);

  Touch touch(const model::Coordinates& q) const override;
  std::string objection(const model::Coordinates& q) const override;
  /// From a depth of 2 % of both radii on.
  std::string overlooked(const model::Coordinates& q) const override;
  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  /// law_out_of_range where a point that was not there before comes, or passes, deeper into the bar
  /// than half of both radii within the step: nothing may pass through a bar.
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  using Factors = Eigen::Matrix<double, 4 * max_nodes, 1>;
  using Motion = model::ItemMotion<max_nodes>;
  /// r = sum_s R_s q_s + r0, e = sum_s E_s q_s + e0.
  struct Item {
    std::vector<int> nodes;
    Factors R = {}, E = {};
    Vec3 r0 = Vec3::Zero(), e0 = Vec3::Zero();
    std::vector<double> weights;  ///< of the nodes of the point
    Vec3 offset = Vec3::Zero();   ///< of the point, in its directors [m]
    double radius = 0.0;          ///< of its surface [m]
    double reach = 0.0;           ///< sum of the radii [m]
    double area = 0.0;            ///< [m^2]
    double length = 0.0;          ///< of its part of a line [m]
  };
  struct Response;

  Vec<2> forms(const Item& item, const model::Coordinates& q) const;
  double distance(const Vec<2>& y) const;
  /// Of a point from the beginning of the axis, and its distance, as the bar sees it.
  Vec3 seen(const Item& item, const model::Coordinates& q) const;
  double distance_of(const Vec3& seen) const;
  /// Of the straight way between two places that the bar sees.
  double least_distance(const Vec3& from, const Vec3& to) const;
  bool passes(const Item& item, const model::State& state) const;
  /// The bar, which may stand in space, and the point, where they touch.
  Pressed press(int number, const Motion& motion, const Response& response,
                const model::State& state, double theta, bool tangent) const;
  /// Nothing where there is none.
  std::optional<Sliding> friction_of(int number, const Motion& motion, const Response& response,
                                     const model::State& state, const Stencil& stencil,
                                     bool tangent) const;
  Response respond(const Item& item, const model::State& state, const Stencil& stencil) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const Item& item_of(int number) const { return items_[static_cast<std::size_t>(number)]; }
  const Item& local(std::size_t i) const { return item_of(placement().items[i]); }

  const model::NodeTable& nodes_;
  Cylinder cylinder_;
  Penalty penalty_;
  Friction friction_;
  std::vector<Item> items_;
};

}  // namespace culm::contact
