#include "reference_wind.hpp"
#include "tower_influence.hpp"

namespace culm::flow {
namespace {

class PowerLaw final : public Flow {
 public:
  explicit PowerLaw(const Options& options)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        speed_(options.number("Speed")),
        height_(options.number("Height")),
        exponent_(options.number("Exponent")) {}

  void velocities(std::span<const Vec3> places, double, std::span<Vec3> velocities) const override {
    for (std::size_t i = 0; i < places.size(); ++i) {
      velocities[i] = speed_ * power_law(axes_.height(places[i]), height_, exponent_) * axes_.along;
    }
  }

 private:
  WindAxes axes_;
  double speed_, height_, exponent_;
};

}  // namespace

void register_power_law(FlowRegistry& registry) {
  add_wind(registry, "Power Law",
           reference_wind_schema("Power Law", "Speed that grows as a power of the height.")
               .add(number("Exponent", "1", "Exponent of the height.").non_negative()),
           [](const Options& options, model::BuildContext&) -> SharedFlow {
             return std::make_shared<PowerLaw>(options);
           });
}

}  // namespace culm::flow
