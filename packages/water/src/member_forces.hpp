/// Forces of water on a segment of a member, with their derivatives where numbers carry them.
#pragma once

#include <culm/water/member.hpp>
#include <culm/water/sea.hpp>

#include "immersion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace culm::water {

/// Of both ends of a segment: place, velocity, acceleration.
template <class Number>
struct SegmentMotion {
  std::array<Vector<Number>, 2> place, velocity, acceleration;
};

/// Water that moves slower than this past a section brings no drag: its direction has no meaning
/// [m/s].
constexpr double no_flow = 1e-12;
/// Tilts below this count as upright: of what slices that are cut would add their square is left
/// [rad].
constexpr double upright = 1e-3;

/// The sum of what acts on a segment, as forces on its two ends. Water is asked for its motion at
/// places without their derivatives. @source fluids B7
template <class Number>
class SegmentForces {
 public:
  SegmentForces(const Segment& segment, const MorisonModel& model, const Sea& sea,
                const SegmentMotion<Number>& motion, double time)
      : segment_(segment), model_(model), sea_(sea), motion_(motion), time_(time) {
    const Vector<Number> axis = motion.place[1] - motion.place[0];
    length_ = sqrt(dot<Number>(axis, axis));
    tangent_ = axis / length_;
    up_ = sea.site().up.template cast<Number>();
    rise_ = dot<Number>(up_, tangent_);
    across_up_ = up_ - rise_ * tangent_;
    forces_ = {Vector<Number>::Constant(Number(0.0)), Vector<Number>::Constant(Number(0.0))};
    immerse();
    add_mantle();
    add_flooding();
    add_growth();
    for (std::size_t end = 0; end < 2; ++end) add_face(end);
  }

  const std::array<Vector<Number>, 2>& forces() const { return forces_; }

 private:
  using Slice = WetSlice<Number>;

  // Depths of the axis under the surface at both ends.
  void immerse() {
    const double thickness = std::max(segment_.sections[0].diameter, segment_.sections[1].diameter);
    for (std::size_t end = 0; end < 2; ++end) {
      const Vec3 place = value_of(motion_.place[end]);
      // what is far above all crests need not ask where they are
      const bool is_far = sea_.height(place) > sea_.highest() + segment_.length + thickness;
      const double surface = is_far ? 0.0 : sea_.wet_to(place, time_);
      immersion_.depths[end] =
          Number(surface + sea_.site().level) - dot<Number>(up_, motion_.place[end]);
      const bool is_near = std::abs(value_of(immersion_.depths[end])) < segment_.length + thickness;
      if (is_near && model_.buoyancy) cut_off_[end] = sea_.pressed_at_surface(place, time_);
    }
    const Number cosine = (immersion_.depths[0] - immersion_.depths[1]) / length_;
    const Number square = Number(1.0) - cosine * cosine;
    const bool is_upright = !(value_of(square) > upright * upright);
    immersion_.sine = is_upright ? Number(0.0) : Number(sqrt(square));
  }

  Cone cone(double WetSection::*diameter) const {
    return {{0.5 * segment_.sections[0].*diameter, 0.5 * segment_.sections[1].*diameter}};
  }
  Number at(double WetSection::*value, const Number& share) const {
    return between(segment_.sections[0].*value, segment_.sections[1].*value, share);
  }
  Vector<Number> across(const Vector<Number>& vector) const {
    return vector - dot<Number>(vector, tangent_) * tangent_;
  }
  WaterMotion water_at(const Number& share) const {
    const Vec3 a = value_of(motion_.place[0]), b = value_of(motion_.place[1]);
    return sea_.motion(a + value_of(share) * (b - a), time_);
  }
  double density() const { return sea_.site().density; }
  double specific_weight() const { return sea_.site().density * sea_.site().gravity; }

  void add(const Number& share, const Vector<Number>& force) {
    const Vector<Number> second = share * force;
    forces_[1] += second;
    forces_[0] += force - second;
  }
  /// A couple that turns the axis: forces across it on both ends.
  void add_couple(const Vector<Number>& force_times_length) {
    const Vector<Number> force = force_times_length / length_;
    forces_[1] += force;
    forces_[0] -= force;
  }

  void add_mantle() {
    Number off_axis(0.0);  // integral of the heights over the axis in wet slices
    const Cone outer = cone(&WetSection::diameter);
    CutPlane plane;
    visit_wet<Number>(
        outer, immersion_, [&](const Number& share, const Number& weight, const Slice& slice) {
          const Number length = weight * Number(segment_.length);
          const Vector<Number> force = force_per_length(share, slice, outer.radius(share));
          add(share, length * force);
          off_axis += length * slice.first;
          see(share, weight, slice, outer, plane);
        });
    if (!model_.buoyancy) return;
    add_righting(outer, off_axis);
    add_cut_off(outer, plane);
  }

  // The plane in which the surface cuts a segment: wide by the chord of a slice, and long by the
  // length over the sine.
  struct CutPlane {
    double area = 0.0, shares = 0.0;  // and its integral with the share of the axis
    // What slices gain in area and first moment by the growth of radii along the axis, where they
    // are wet.
    double grown_area = 0.0, grown_first = 0.0;
  };
  void see(const Number& share, const Number& weight, const Slice& slice, const Cone& cone,
           CutPlane& plane) const {
    if (cut_off_[0] == 0.0 && cut_off_[1] == 0.0) return;  // nothing presses there
    const double at = value_of(share), radius = cone.radius(at);
    const double growth = value_of(weight) * (cone.radii[1] - cone.radii[0]);
    const double sine = value_of(immersion_.sine);
    const bool is_cut = slice.chord > 0.0 && sine > 0.0;
    const double depth =
        std::lerp(value_of(immersion_.depths[0]), value_of(immersion_.depths[1]), at);
    const double angle =
        is_cut ? std::acos(std::clamp(-depth / (sine * radius), -1.0, 1.0)) : std::numbers::pi;
    plane.grown_area += 2.0 * radius * angle * growth;
    plane.grown_first -= radius * slice.chord * growth;
    if (!is_cut) return;
    const double area = value_of(weight) * segment_.length * slice.chord / sine;
    plane.area += area;
    plane.shares += at * area;
  }

  // Where waves are counted up to still water only, the volume ends at a plane on which their
  // pressure would act, and there is no face: it is taken back, as is what vertical stretching
  // leaves in troughs. Of members that stand the plane is what is lost of the area of slices from
  // one end to the other; where it crosses a joint, its parts and those of the dry faces there
  // change quickly with the tilt, and their sum does not, nor may its derivative.
  // @param sign  -1 for water inside
  void add_cut_off(const Cone& cone, const CutPlane& plane, double sign = 1.0) {
    constexpr double standing = 0.5;  // sine of the inclination
    const double h0 = value_of(immersion_.depths[0]), h1 = value_of(immersion_.depths[1]);
    const bool is_upright = !(value_of(immersion_.sine) > 0.0);
    if (is_upright ? (h0 > 0.0) == (h1 > 0.0) : plane.area <= 0.0) return;
    const double share = is_upright ? h0 / (h0 - h1) : plane.shares / plane.area;
    const double height = sign * std::lerp(cut_off_[0], cut_off_[1], share);
    if (height == 0.0) return;
    const Number pressure(specific_weight() * height);
    const Slice first = slice_at<Number>(cone, immersion_, Number(0.0));
    const Slice last = slice_at<Number>(cone, immersion_, Number(1.0));
    const bool stands = std::abs(value_of(rise_)) > standing;
    const Number area = stands ? Number((first.area - last.area + Number(plane.grown_area)) / rise_)
                               : Number(plane.area);
    add(Number(share), pressure * area * up_);
    if (is_upright) return;
    // about its middle on the axis, as in take_back_pressure
    const Number lever = first.first - last.first + Number(plane.grown_first);
    add_couple(Number(-pressure * lever / immersion_.sine) * across_up_);
  }

  // Water inside that is open to that outside: its pressure is the same, and it moves along across
  // the axis.
  void add_flooding() {
    const Cone inner = cone(&WetSection::flooded_diameter);
    if (inner.radii[0] <= 0.0 && inner.radii[1] <= 0.0) return;
    Number off_axis(0.0);
    CutPlane plane;
    visit_wet<Number>(
        inner, immersion_, [&](const Number& share, const Number& weight, const Slice& slice) {
          const Number mass = weight * Number(segment_.length * density()) * slice.area;
          const Vector<Number> acceleration =
              between<Number>(motion_.acceleration[0], motion_.acceleration[1], share);
          Vector<Number> force = -across(acceleration);
          if (model_.buoyancy) {
            const Vector<Number> water = water_at(share).push.template cast<Number>();
            force -= dot<Number>(water, tangent_) * tangent_;
            force -= Number(sea_.site().gravity) * up_;
          }
          see(share, weight, slice, inner, plane);
          add(share, mass * force);
          off_axis -= weight * Number(segment_.length) * slice.first;
        });
    if (!model_.buoyancy) return;
    add_righting(inner, off_axis, -1.0);
    add_cut_off(inner, plane, -1.0);
  }

  // The moment of wet slices that are not wet as a whole. Where the axis is upright it is what
  // remains: the second moment of the waterplane.
  void add_righting(const Cone& cone, const Number& off_axis, double sign = 1.0) {
    Number lever(0.0);
    if (value_of(immersion_.sine) > 0.0) {
      lever = -off_axis / immersion_.sine;
    } else {
      const double h0 = value_of(immersion_.depths[0]), h1 = value_of(immersion_.depths[1]);
      if ((h0 > 0.0) == (h1 > 0.0)) return;
      const double radius = cone.radius(h0 / (h0 - h1));
      lever = Number(sign * 0.25 * std::numbers::pi * std::pow(radius, 4));
    }
    add_couple(Number(Number(specific_weight()) * lever * rise_) * across_up_);
  }

  Vector<Number> force_per_length(const Number& share, const Slice& slice,
                                  const Number& radius) const {
    const WaterMotion water = water_at(share);
    const Vector<Number> current = water.velocity.template cast<Number>();
    const Vector<Number> pull = water.acceleration.template cast<Number>();
    const Vector<Number> velocity =
        between<Number>(motion_.velocity[0], motion_.velocity[1], share);
    const Vector<Number> acceleration =
        between<Number>(motion_.acceleration[0], motion_.acceleration[1], share);
    const Number mass = Number(density()) * slice.area;
    const Vector<Number> pulled = pull - acceleration;

    // fluid inertia
    Vector<Number> force = Number(mass * at(&WetSection::added_mass, share)) * across(pulled);
    force +=
        Number(mass * at(&WetSection::axial_added_mass, share) * dot<Number>(pulled, tangent_)) *
        tangent_;
    // pressure of the undisturbed water; along the axis it must fit that on the faces
    if (model_.buoyancy) {
      const Vector<Number> push = water.push.template cast<Number>();
      force += mass * (across(pull) + dot<Number>(push, tangent_) * tangent_ +
                       Number(sea_.site().gravity) * up_);
    } else if (model_.pull) {
      force += mass * across(pull);
    }
    // drag across and friction along, on the wet share of the section
    const Vector<Number> relative = current - velocity;
    const Number wet = slice.area / (Number(std::numbers::pi) * radius * radius);
    const Number width = Number(0.5 * density()) * wet * Number(2.0) * radius;
    const Vector<Number> cross = across(relative);
    const Number square = dot<Number>(cross, cross);
    if (value_of(square) > no_flow * no_flow) {
      force += Number(width * at(&WetSection::drag, share) * sqrt(square)) * cross;
    }
    const Number along = dot<Number>(relative, tangent_);
    force += Number(width * Number(std::numbers::pi) * at(&WetSection::axial_drag, share) *
                    size_of(along) * along) *
             tangent_;
    return force;
  }

  void add_growth() {
    if (segment_.sections[0].growth_mass <= 0.0 && segment_.sections[1].growth_mass <= 0.0) return;
    for (const auto& [xi, weight] : gauss_legendre(2)) {
      const Number share(0.5 * (1.0 + xi));
      const Number mass =
          Number(0.5 * weight * segment_.length) * at(&WetSection::growth_mass, share);
      const Vector<Number> acceleration =
          between<Number>(motion_.acceleration[0], motion_.acceleration[1], share);
      add(share, -mass * (acceleration + Number(sea_.site().gravity) * up_));
    }
  }

  void add_face(std::size_t end) {
    if (segment_.faces[end] == Face::none) return;
    const Number share(static_cast<double>(end));
    const Cone outer = cone(&WetSection::diameter);
    const Slice slice = slice_at<Number>(outer, immersion_, share);
    if (value_of(slice.area) <= 0.0) return;
    if (segment_.faces[end] == Face::wet) {
      add_wet_face(end, slice, outer.radii[end]);
    } else if (model_.buoyancy) {
      take_back_pressure(end, slice, outer.radii[end], 1.0);
      const Cone inner = cone(&WetSection::flooded_diameter);
      if (inner.radii[end] <= 0.0) return;
      take_back_pressure(end, slice_at<Number>(inner, immersion_, share), inner.radii[end], -1.0);
    }
  }

  // Drag and added mass of a plate or a blunt end.
  void add_wet_face(std::size_t end, const Slice& slice, double radius) {
    if (segment_.goes_on[end]) return;  // a cut, and no end
    if (model_.end_drag[end] == 0.0 && model_.end_added_mass[end] == 0.0) return;
    const WaterMotion water = water_at(Number(static_cast<double>(end)));
    const Vector<Number> relative = water.velocity.template cast<Number>() - motion_.velocity[end];
    const Vector<Number> pulled =
        water.acceleration.template cast<Number>() - motion_.acceleration[end];
    const Number along = dot<Number>(relative, tangent_);
    Number force =
        Number(0.5 * density() * model_.end_drag[end]) * slice.area * size_of(along) * along;
    // 2/3 pi R^3 = 2/3 R A
    force += Number(density() * model_.end_added_mass[end] * 2.0 / 3.0 * radius) * slice.area *
             dot<Number>(pulled, tangent_);
    forces_[end] += force * tangent_;
  }

  // The volume of a member stands for the pressure on all of its surface; no water touches this
  // face. @param sign  -1 for the part of it that is open
  void take_back_pressure(std::size_t end, const Slice& slice, double radius, double sign) {
    // of water at rest that presses as much at the centre
    const double waves = water_at(Number(static_cast<double>(end))).pressure;
    const Number level = Number(sea_.site().level) - dot<Number>(up_, motion_.place[end]) +
                         Number(waves / specific_weight());
    const Number depth = immersion_.depths[end];
    const Number weight(sign * specific_weight());
    const Vector<Number> outward = Number(end == 0 ? -1.0 : 1.0) * tangent_;
    const Number pressed = weight * (level * slice.area - immersion_.sine * slice.first);
    forces_[end] += pressed * outward;
    // moment about the centre: (level S - sine Q) n x t_out with n = across_up / sine
    const bool is_cut = value_of(immersion_.sine) > 0.0 &&
                        std::abs(value_of(depth)) < radius * value_of(immersion_.sine);
    Number second(0.25 * std::numbers::pi * std::pow(radius, 4));
    if (is_cut) {
      const Number p = depth / immersion_.sine;
      const double half_square = radius * radius - value_of(p) * value_of(p);
      const double slope = 2.0 * value_of(p) * value_of(p) * std::sqrt(std::max(half_square, 0.0));
      second = chain(wet_second_moment(value_of(p), radius), p, slope, p, 0.0) -
               level / immersion_.sine * slice.first;
    }
    const Number direction(end == 0 ? -1.0 : 1.0);
    add_couple(Number(weight * direction * second) * across_up_);
  }

  const Segment& segment_;
  const MorisonModel& model_;
  const Sea& sea_;
  const SegmentMotion<Number>& motion_;
  double time_;
  Vector<Number> tangent_, up_, across_up_;
  Number length_, rise_;
  Immersion<Number> immersion_;
  std::array<double, 2> cut_off_{};  // pressure where what is wet ends, at both ends [m]
  std::array<Vector<Number>, 2> forces_;
};

}  // namespace culm::water
