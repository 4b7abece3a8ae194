/// Media that structures stand or move in.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/math/types.hpp>
#include <culm/model/build_context.hpp>

#include <memory>
#include <span>
#include <string>

namespace culm::flow {

class Flow;
/// Shared by all loads that act in it.
using SharedFlow = std::shared_ptr<const Flow>;

/// A fluid with a velocity of its own at each place [m] and time [s], which structures do not
/// disturb, but for one that it stands about.
class Flow {
 public:
  explicit Flow(double density) : density_(density) {}
  virtual ~Flow() = default;

  double density() const { return density_; }  ///< [kg/m^3]
  /// Velocities at places, one each [m/s]. May throw InputError where the flow is not known.
  virtual void velocities(std::span<const Vec3> places, double time,
                          std::span<Vec3> velocities) const = 0;
  /// Derivative of the velocity by the place [1/s]; of one side where it has a kink. It only serves
  /// the tangent: zero of a flow that does not know it.
  virtual Mat3 gradient(const Vec3& /*place*/, double /*time*/) const { return Mat3::Zero(); }
  /// Whether a place is where the flow is: not below the ground, where winds by their height
  /// vanish.
  virtual bool is_above_ground(const Vec3& /*place*/) const { return true; }
  /// At which time statics and linearisations see the flow, by their level: winds grow with it.
  virtual double time_at_level(double level) const { return level; }
  /// Which part of a piece is in the fluid, as of one that pierces the surface of water.
  /// @param extent  from the middle of the piece to one of its ends [m]
  virtual double share_within(const Vec3& /*place*/, const Vec3& /*extent*/,
                              double /*time*/) const {
    return 1.0;
  }
  /// The structure that the flow stands about; empty: none.
  virtual std::string stands_about() const { return {}; }
  /// The flow as it is without that structure; null where there is none.
  virtual SharedFlow without_structure() const { return nullptr; }
  /// The velocity at one place.
  Vec3 velocity(const Vec3& place, double time) const {
    Vec3 result;
    velocities({&place, 1}, time, {&result, 1});
    return result;
  }

 private:
  double density_ = 0.0;
};

/// Types of the deck's list "Flows", made when all structures are there.
using FlowRegistry = Registry<SharedFlow, model::BuildContext&>;

/// All types of this package: Uniform, Power Law, Log Law, Table, Gust, TurbSim Box, Mann Box.
void register_flows(FlowRegistry& registry);

}  // namespace culm::flow
