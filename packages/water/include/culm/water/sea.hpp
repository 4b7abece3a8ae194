/// Water with waves and a current.
#pragma once

#include <culm/flow/flow.hpp>
#include <culm/water/current.hpp>
#include <culm/water/wave.hpp>

#include <span>
#include <vector>

namespace culm::water {

/// Where the water is, and what it is.
struct Site {
  double density = 0.0;     ///< [kg/m^3]
  double depth = 0.0;       ///< [m]
  double gravity = 0.0;     ///< [m/s^2]
  double level = 0.0;       ///< of still water above the origin, along `up` [m]
  Vec3 up = Vec3::UnitZ();  ///< unit vector
};

/// How the theory of small waves, which ends at still water, reaches up to the surface.
enum class Stretching {
  none,      ///< nothing is wet above still water
  vertical,  ///< above still water as at it
  wheeler,   ///< profiles are stretched from the sea bed to the surface
};

/// What water does at a place.
struct WaterMotion {
  Vec3 velocity = Vec3::Zero();      ///< with the current [m/s]
  Vec3 acceleration = Vec3::Zero();  ///< of the waves at the place, without convection [m/s^2]
  double pressure = 0.0;             ///< of the waves, beside that of water at rest [Pa]
  /// What its gradient makes of water, -grad p / density: the acceleration, but where the theory is
  /// stretched [m/s^2].
  Vec3 push = Vec3::Zero();
};

/// A sea of constant depth with waves by Airy's theory and a current, which do not know of each
/// other. Places below the bed count as at it. @source fluids B7
class Sea final : public flow::Flow {
 public:
  /// @param rise   time in which waves grow to their height, by half a cosine; 0: they are there
  /// [s]
  /// @param shown  side of the square around the origin that pictures show; 0: none [m]
  Sea(const Site& site, std::vector<Wave> waves, Current current, Stretching stretching,
      double rise, double shown);

  const Site& site() const { return site_; }
  std::span<const Wave> waves() const { return waves_; }
  /// Of a place over still water [m].
  double height(const Vec3& place) const { return site_.up.dot(place) - site_.level; }
  /// Of the surface over still water [m].
  double elevation(const Vec3& place, double time) const;
  /// Up to which height over still water things are wet [m].
  double wet_to(const Vec3& place, double time) const {
    return stretching_ == Stretching::none ? 0.0 : elevation(place, time);
  }
  /// Pressure that the theory leaves where what is wet ends, above a place or below it, as a height
  /// of water: none after Wheeler [m].
  double pressed_at_surface(const Vec3& place, double time) const;
  /// No surface is farther from still water [m].
  double highest() const { return highest_; }
  const Current& current() const { return current_; }
  /// Height above which the longest of the waves breaks, which is the highest that it can have; 0
  /// where there are none [m].
  double breaking_height() const;
  /// Length of the highest wave; infinite where there are none [m].
  double main_length() const;
  double shown() const { return shown_; }
  /// Share of their height that the waves have [1].
  double growth(double time) const;
  WaterMotion motion(const Vec3& place, double time) const;
  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override;
  /// Waves stand as they are when time begins, whatever the level.
  double time_at_level(double) const override { return 0.0; }
  /// Between the bed and the surface; of a piece that lies at the surface it grows within a tenth
  /// of its length.
  double share_within(const Vec3& place, const Vec3& extent, double time) const override;

 private:
  // Where the profiles of the theory are taken.
  struct Profile {
    double height = 0.0;           // from the bed to still water [m]
    Vec3 gradient = Vec3::Zero();  // of this height
  };
  Profile profile_at(const Vec3& place, double time) const;

  Site site_;
  std::vector<Wave> waves_;
  std::vector<double> at_bed_;  // exp(-2 k d) of each
  Current current_;
  Stretching stretching_;
  double rise_, shown_;
  double highest_ = 0.0;
};

}  // namespace culm::water
