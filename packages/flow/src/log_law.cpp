#include "reference_wind.hpp"
#include "tower_influence.hpp"
#include "wind_function.hpp"

#include <utility>

namespace culm::flow {
namespace {

class LogLaw final : public Flow {
 public:
  LogLaw(const Options& options, model::Amplitude amplitude)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        roughness_(options.number("Roughness")),
        friction_(options.number("Speed") / std::log(options.number("Height") / roughness_)),
        amplitude_(std::move(amplitude)) {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    const double friction = amplitude_.at(time) * friction_;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double height = axes_.height(places[i]);
      const double speed = height > roughness_ ? friction * std::log(height / roughness_) : 0.0;
      velocities[i] = speed * axes_.along;
    }
  }
  Mat3 gradient(const Vec3& place, double time) const override {
    const double height = axes_.height(place);
    if (height <= roughness_) return Mat3::Zero();
    return amplitude_.at(time) * friction_ / height * axes_.along * axes_.up.transpose();
  }

  bool is_above_ground(const Vec3& place) const override {
    return axes_.height(place) > roughness_;
  }

 private:
  WindAxes axes_;
  double roughness_;
  double friction_;  // speed per logarithm of the height
  model::Amplitude amplitude_;
};

}  // namespace

void register_log_law(FlowRegistry& registry) {
  add_wind(registry, "Log Law",
           reference_wind_schema("Log Law", "Speed that grows with the logarithm of the height.")
               .add(number("Roughness", "m", "Height at which the wind vanishes.").positive())
               .add(wind_function_field())
               .check([](const Options& options, InputIssues& issues) {
                 if (options.number("Roughness") < options.number("Height")) return;
                 issues.add(options.where("Roughness"), "must be less than 'Height'");
               }),
           [](const Options& options, model::BuildContext& context) -> SharedFlow {
             auto function = find_wind_function(options, context);
             if (!function) return nullptr;
             return std::make_shared<LogLaw>(options, *std::move(function));
           });
}

}  // namespace culm::flow
