#include "tower_influence.hpp"
#include "types.hpp"
#include "wind_function.hpp"

#include <algorithm>

namespace culm::flow {
namespace {

class Uniform final : public Flow {
 public:
  Uniform(double density, Vec3 velocity, model::Amplitude amplitude)
      : Flow(density), velocity_(std::move(velocity)), amplitude_(std::move(amplitude)) {}

  void velocities(std::span<const Vec3>, double time, std::span<Vec3> velocities) const override {
    std::fill(velocities.begin(), velocities.end(), Vec3(amplitude_.at(time) * velocity_));
  }

 private:
  Vec3 velocity_;
  model::Amplitude amplitude_;
};

}  // namespace

void register_uniform(FlowRegistry& registry) {
  add_wind(registry, "Uniform",
           Schema("Uniform", "The same velocity everywhere.")
               .add(density_field())
               .add(model::vector_field("Velocity", "m/s", "Velocity in space."))
               .add(wind_function_field()),
           [](const Options& options, model::BuildContext& context) -> SharedFlow {
             const auto function = find_wind_function(options, context);
             if (!function) return nullptr;
             return std::make_shared<Uniform>(options.number("Density"),
                                              model::vector(options, "Velocity"), *function);
           });
}

}  // namespace culm::flow
