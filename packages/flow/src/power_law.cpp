#include "reference_wind.hpp"
#include "tower_influence.hpp"
#include "wind_function.hpp"

#include <utility>

namespace culm::flow {
namespace {

class PowerLaw final : public Flow {
 public:
  PowerLaw(const Options& options, model::Amplitude amplitude)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        speed_(options.number("Speed")),
        height_(options.number("Height")),
        exponent_(options.number("Exponent")),
        amplitude_(std::move(amplitude)) {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    const double speed = amplitude_.at(time) * speed_;
    for (std::size_t i = 0; i < places.size(); ++i) {
      velocities[i] = speed * power_law(axes_.height(places[i]), height_, exponent_) * axes_.along;
    }
  }
  Mat3 gradient(const Vec3& place, double time) const override {
    const double slope = power_law_slope(axes_.height(place), height_, exponent_);
    return amplitude_.at(time) * speed_ * slope * axes_.along * axes_.up.transpose();
  }

  bool is_above_ground(const Vec3& place) const override { return axes_.height(place) > 0.0; }

 private:
  WindAxes axes_;
  double speed_, height_, exponent_;
  model::Amplitude amplitude_;
};

}  // namespace

void register_power_law(FlowRegistry& registry) {
  add_wind(registry, "Power Law",
           reference_wind_schema("Power Law", "Speed that grows as a power of the height.")
               .add(number("Exponent", "1", "Exponent of the height.").non_negative())
               .add(wind_function_field()),
           [](const Options& options, model::BuildContext& context) -> SharedFlow {
             auto function = find_wind_function(options, context);
             if (!function) return nullptr;
             return std::make_shared<PowerLaw>(options, *std::move(function));
           });
}

}  // namespace culm::flow
