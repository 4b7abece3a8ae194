#include <culm/water/sea.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace culm::water {
namespace {

// Of a wave at a place and time.
double phase_of(const Wave& wave, const Vec3& place, double time) {
  return wave.number * wave.direction.dot(place) - wave.frequency * time + wave.phase;
}

}  // namespace

Sea::Sea(const Site& site, std::vector<Wave> waves, Current current, Stretching stretching,
         double rise, double shown)
    : Flow(site.density),
      site_(site),
      waves_(std::move(waves)),
      current_(std::move(current)),
      stretching_(stretching),
      rise_(rise),
      shown_(shown) {
  for (const Wave& wave : waves_) {
    highest_ += std::abs(wave.amplitude);
    at_bed_.push_back(std::exp(-2.0 * wave.number * site.depth));
  }
}

double Sea::main_length() const {
  if (highest_ == 0.0) return std::numeric_limits<double>::infinity();
  const auto main = std::ranges::max_element(
      waves_, {}, [](const Wave& wave) { return std::abs(wave.amplitude); });
  return 2.0 * std::numbers::pi / main->number;
}

double Sea::growth(double time) const {
  if (time >= rise_) return 1.0;
  return 0.5 * (1.0 - std::cos(std::numbers::pi * std::max(time, 0.0) / rise_));
}

double Sea::elevation(const Vec3& place, double time) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += wave.amplitude * std::cos(phase_of(wave, place, time));
  return growth(time) * sum;
}

// Height at which the profiles of the theory are taken, from the bed to still water.
double Sea::profile_height(const Vec3& place, double time) const {
  double z = height(place);
  if (stretching_ == Stretching::wheeler && !waves_.empty()) {
    const double surface = elevation(place, time);
    // waves that bare the bed are beyond the theory; nothing there is wet
    z = site_.depth * (z - surface) / std::max(site_.depth + surface, 1e-3 * site_.depth);
  }
  return std::clamp(z, -site_.depth, 0.0);
}

// The ratios cosh k(z+d) / sinh kd and sinh k(z+d) / sinh kd stand in a form that does not
// overflow.
WaterMotion Sea::motion(const Vec3& place, double time) const {
  const double z = profile_height(place, time);
  const double g = growth(time);
  WaterMotion motion;
  motion.velocity = current_.at(z);
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const Wave& wave = waves_[i];
    const double phase = phase_of(wave, place, time);
    const double c = std::cos(phase), s = std::sin(phase);
    const double upward = std::exp(wave.number * z);
    const double whole = at_bed_[i];
    const double mirrored = std::exp(-2.0 * wave.number * (z + site_.depth));
    const double across = upward * (1.0 + mirrored) / (1.0 - whole);
    const double along = upward * (1.0 - mirrored) / (1.0 - whole);
    const double speed = g * wave.amplitude * wave.frequency;
    motion.velocity += speed * (across * c * wave.direction + along * s * site_.up);
    motion.acceleration +=
        speed * wave.frequency * (across * s * wave.direction - along * c * site_.up);
    motion.pressure += site_.density * site_.gravity * g * wave.amplitude * c * upward *
                       (1.0 + mirrored) / (1.0 + whole);
  }
  return motion;
}

void Sea::velocities(std::span<const Vec3> places, double time, std::span<Vec3> velocities) const {
  std::ranges::transform(places, velocities.begin(),
                         [&](const Vec3& place) { return motion(place, time).velocity; });
}

}  // namespace culm::water
