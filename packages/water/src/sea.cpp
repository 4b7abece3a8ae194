#include <culm/water/dispersion.hpp>
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

double Sea::breaking_height() const {
  double highest = 0.0;
  for (const Wave& wave : waves_) {
    highest = std::max(highest, water::breaking_height(wave.number, site_.depth));
  }
  return highest;
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

Sea::Profile Sea::profile_at(const Vec3& place, double time) const {
  const double d = site_.depth;
  double z = height(place);
  Profile profile{0.0, site_.up};
  if (stretching_ == Stretching::wheeler && !waves_.empty()) {
    double surface = 0.0;
    Vec3 slope = Vec3::Zero();
    for (const Wave& wave : waves_) {
      const double phase = phase_of(wave, place, time);
      surface += wave.amplitude * std::cos(phase);
      slope -= wave.amplitude * wave.number * std::sin(phase) * wave.direction;
    }
    surface *= growth(time);
    slope *= growth(time);
    // waves that bare the bed are beyond the theory; nothing there is wet
    const double whole = std::max(d + surface, 1e-3 * d);
    profile.gradient = d / whole * (site_.up - (d + z) / whole * slope);
    z = d * (z - surface) / whole;
  }
  profile.height = std::clamp(z, -d, 0.0);
  // as at still water, all the way up
  if (z > 0.0) profile.gradient.setZero();
  return profile;
}

// The ratios cosh k(z+d) / sinh kd and sinh k(z+d) / sinh kd stand in a form that does not
// overflow.
WaterMotion Sea::motion(const Vec3& place, double time) const {
  const Profile profile = profile_at(place, time);
  const double z = profile.height;
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
  const double upward = motion.acceleration.dot(site_.up);
  motion.push = motion.acceleration + upward * (profile.gradient - site_.up);
  return motion;
}

double Sea::pressed_at_surface(const Vec3& place, double time) const {
  if (stretching_ == Stretching::wheeler || waves_.empty()) return 0.0;
  const double surface = wet_to(place, time);
  const Vec3 there = place + (surface - height(place)) * site_.up;
  return motion(there, time).pressure / (site_.density * site_.gravity) - surface;
}

void Sea::velocities(std::span<const Vec3> places, double time, std::span<Vec3> velocities) const {
  std::ranges::transform(places, velocities.begin(),
                         [&](const Vec3& place) { return motion(place, time).velocity; });
}

double Sea::share_within(const Vec3& place, const Vec3& extent, double time) const {
  constexpr double flat = 0.1;
  const double reach = std::max(std::abs(site_.up.dot(extent)), flat * extent.norm());
  const double z = height(place);
  if (z + reach <= -highest_ && z - reach >= -site_.depth) return 1.0;
  const auto share = [reach](double inside) {
    return std::clamp(0.5 + 0.5 * inside / reach, 0.0, 1.0);
  };
  return std::max(share(wet_to(place, time) - z) + share(z + site_.depth) - 1.0, 0.0);
}

}  // namespace culm::water
