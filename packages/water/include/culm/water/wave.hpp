/// Waves that a sea is made of.
#pragma once

#include <culm/math/types.hpp>
#include <culm/water/spectrum.hpp>

#include <cstdint>
#include <vector>

namespace culm::water {

/// One harmonic wave of Airy's theory: the surface rises by
/// amplitude cos(number direction . x - frequency t + phase).
struct Wave {
  double amplitude = 0.0;         ///< [m]
  double frequency = 0.0;         ///< omega [rad/s]
  double number = 0.0;            ///< k [rad/m]
  double phase = 0.0;             ///< [rad]
  Vec3 direction = Vec3::Zero();  ///< horizontal unit vector, where it goes to
};

/// Frequencies between which a spectrum is cut into waves [Hz].
struct Band {
  double lowest = 0.0, highest = 0.0;
};

/// Amplitudes [m], frequencies [Hz] and phases of waves that make up a sea: equal parts of the
/// band, in each a wave at a random place with a random phase. Their variance is height^2 / 16.
/// The same on every machine but for the rounding of its functions. Numbers and directions are left
/// to the caller.
std::vector<Wave> random_waves(const SeaState& sea, Band band, int count, std::uint64_t seed);

/// How the directions of waves differ from the main one: their density by the angle is
/// cos^exponent(pi angle / range) within half the range on both sides.
struct Spreading {
  double exponent = 0.0;  ///< 0: all alike
  double range = 0.0;     ///< [rad]
};

/// Angles from the main direction [rad], one for each of the waves in the order of their
/// frequencies: those of neighbours lie evenly in the density, whatever their number.
/// @source DNV-RP-C205, section 3.5.8, with range pi; range 2 pi is the form cos^2s of half the
/// angle
std::vector<double> spread_angles(const Spreading& spreading, int count, std::uint64_t seed);

}  // namespace culm::water
