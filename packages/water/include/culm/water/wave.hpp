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

}  // namespace culm::water
