#include "reference_wind.hpp"
#include "tower_influence.hpp"

namespace culm::flow {
namespace {

class LogLaw final : public Flow {
 public:
  explicit LogLaw(const Options& options)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        roughness_(options.number("Roughness")),
        friction_(options.number("Speed") / std::log(options.number("Height") / roughness_)) {}

  void velocities(std::span<const Vec3> places, double, std::span<Vec3> velocities) const override {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double height = axes_.height(places[i]);
      const double speed = height > roughness_ ? friction_ * std::log(height / roughness_) : 0.0;
      velocities[i] = speed * axes_.along;
    }
  }

 private:
  WindAxes axes_;
  double roughness_;
  double friction_;  // speed per logarithm of the height
};

}  // namespace

void register_log_law(FlowRegistry& registry) {
  add_wind(registry, "Log Law",
           reference_wind_schema("Log Law", "Speed that grows with the logarithm of the height.")
               .add(number("Roughness", "m", "Height at which the wind vanishes.").positive())
               .check([](const Options& options, InputIssues& issues) {
                 if (options.number("Roughness") < options.number("Height")) return;
                 issues.add(options.where("Roughness"), "must be less than 'Height'");
               }),
           [](const Options& options, model::BuildContext&) -> SharedFlow {
             return std::make_shared<LogLaw>(options);
           });
}

}  // namespace culm::flow
