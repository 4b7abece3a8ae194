#include <culm/water/wave.hpp>

#include <boost/math/special_functions/beta.hpp>

#include <cmath>
#include <numbers>

namespace culm::water {
namespace {

// The mixing function of splitmix64 (Steele, Lea, Flood 2014), a bijection of 64-bit words.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

// From 0 to below 1; it follows from seed and number alone.
double draw(std::uint64_t seed, std::uint64_t number) {
  return std::ldexp(static_cast<double>(mix(mix(seed) ^ number) >> 11U), -53);
}

}  // namespace

std::vector<Wave> random_waves(const SeaState& sea, Band band, int count, std::uint64_t seed) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double part = (band.highest - band.lowest) / count;
  std::vector<Wave> waves;
  double variance = 0.0;
  for (int i = 0; i < count; ++i) {
    const auto number = 2 * static_cast<std::uint64_t>(i);
    const double frequency = band.lowest + (i + draw(seed, number)) * part;
    Wave wave;
    wave.amplitude = std::sqrt(2.0 * jonswap(sea, frequency) * part);
    wave.frequency = turn * frequency;
    wave.phase = turn * draw(seed, number + 1);
    variance += 0.5 * wave.amplitude * wave.amplitude;
    waves.push_back(wave);
  }
  const double factor = 0.25 * sea.height / std::sqrt(variance);
  for (Wave& wave : waves) wave.amplitude *= factor;
  return waves;
}

// Boost would compute in long double, which angles of waves do not need and which takes long to
// compile.
using Doubles = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

// With v = sin(pi angle / range), (1 + v) / 2 has a beta distribution with both parameters
// (exponent + 1) / 2. Multiples of the golden ratio, without their integers, fill the interval from
// 0 to 1 evenly however many follow each other.
std::vector<double> spread_angles(const Spreading& spreading, int count, std::uint64_t seed) {
  const double a = 0.5 * (spreading.exponent + 1.0);
  const double begin = draw(seed, ~std::uint64_t{0});
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) {
    const double whole = begin + i / std::numbers::phi;
    const double v = 2.0 * boost::math::ibeta_inv(a, a, whole - std::floor(whole), Doubles()) - 1.0;
    angles.push_back(spreading.range / std::numbers::pi * std::asin(v));
  }
  return angles;
}

}  // namespace culm::water
