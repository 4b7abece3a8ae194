/// Points that touch, and what is known of them.
#pragma once

#include <culm/model/state.hpp>
#include <culm/model/structure.hpp>

#include <string>

namespace culm::contact {

/// A point with a round surface, which stands for an area.
struct ContactPoint {
  model::Marker centre;
  double radius = 0.0;  ///< [m]
  double area = 0.0;    ///< on which the pressure acts [m^2]
  double length = 0.0;  ///< of the part of a line that it stands for; 0 of a sphere [m]
};

/// What touches.
struct Touch {
  double force = 0.0;  ///< normal force by the depths, without damping [N]
  double depth = 0.0;  ///< the largest one; negative: the least distance [m]
  double area = 0.0;   ///< that is pressed [m^2]
};

/// A load by contact.
class Contact {
 public:
  virtual ~Contact() = default;
  /// Of all points, where they are at q.
  virtual Touch touch(const model::Coordinates& q) const = 0;
  /// Why no analysis should begin at q, as what follows the name of what touches; empty if it may.
  virtual std::string objection(const model::Coordinates& q) const {
    (void)q;
    return {};
  }
  /// What analyses without time leave out of it, as what follows its name; empty if nothing.
  virtual std::string left_out_at_rest() const { return {}; }
  /// What touches at q where no point is that would see it, as what follows its name; empty if
  /// nothing that matters.
  virtual std::string overlooked(const model::Coordinates& q) const {
    (void)q;
    return {};
  }
};

/// The place of a marker.
Vec3 place_of(const model::Marker& marker, const model::Coordinates& q);

}  // namespace culm::contact
