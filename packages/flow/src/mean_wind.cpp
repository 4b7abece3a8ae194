#include "mean_wind.hpp"

#include "reference_wind.hpp"
#include "wind_axes.hpp"

#include <cmath>
#include <utility>

namespace culm::flow {
namespace {

constexpr double usual_exponent = 0.2;

class TurbulentWind final : public Flow {
 public:
  TurbulentWind(const Options& options, double speed, SharedFlow fluctuations)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        speed_(speed),
        height_(options.number("Height")),
        exponent_(options.has("Exponent") ? options.number("Exponent") : usual_exponent),
        roughness_(options.has("Roughness") ? options.number("Roughness") : 0.0),
        fluctuations_(std::move(fluctuations)) {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    fluctuations_->velocities(places, time, velocities);
    for (std::size_t i = 0; i < places.size(); ++i) {
      velocities[i] += speed_ * profile(axes_.height(places[i])) * axes_.along;
    }
  }
  Mat3 gradient(const Vec3& place, double time) const override {
    const double slope = speed_ * profile_slope(axes_.height(place));
    return fluctuations_->gradient(place, time) + slope * axes_.along * axes_.up.transpose();
  }

  bool is_above_ground(const Vec3& place) const override {
    return axes_.height(place) > roughness_;
  }

 private:
  double profile(double height) const {
    if (roughness_ == 0.0) return power_law(height, height_, exponent_);
    return height > roughness_ ? std::log(height / roughness_) / std::log(height_ / roughness_)
                               : 0.0;
  }
  double profile_slope(double height) const {
    if (roughness_ == 0.0) return power_law_slope(height, height_, exponent_);
    return height > roughness_ ? 1.0 / (height * std::log(height_ / roughness_)) : 0.0;
  }

  WindAxes axes_;
  double speed_, height_, exponent_;
  double roughness_;  // 0: the power law
  SharedFlow fluctuations_;
};

}  // namespace

Schema mean_profile_schema() {
  return Schema("")
      .add(number("Exponent", "1",
                  "Exponent of the height in the mean wind; 0.2 if neither this nor 'Roughness' is "
                  "given.")
               .non_negative()
               .optional())
      .add(number("Roughness", "m",
                  "Height at which the mean wind vanishes, which then grows with the logarithm of "
                  "the height, in place of 'Exponent'.")
               .positive()
               .optional())
      .check([](const Options& options, InputIssues& issues) {
        if (!options.has("Roughness")) return;
        if (options.has("Exponent")) {
          issues.add(options.where("Roughness"), "stands in place of 'Exponent'; give one of them");
        }
        if (options.has("Height") && options.number("Roughness") >= options.number("Height")) {
          issues.add(options.where("Roughness"), "must be less than 'Height'");
        }
      });
}

SharedFlow add_mean_wind(const Options& options, double speed, SharedFlow fluctuations) {
  return std::make_shared<TurbulentWind>(options, speed, std::move(fluctuations));
}

}  // namespace culm::flow
