#include <culm/base/schema.hpp>

#include "types.hpp"

#include <cmath>
#include <numbers>

namespace culm::strip {
namespace {

// Thin-airfoil theory, and coefficients of drag and moment that do not depend on the angle.
class Thin final : public Airfoil {
 public:
  Thin(double slope, double zero_lift, double drag, double moment)
      : slope_(slope), zero_lift_(zero_lift), drag_(drag), moment_(moment) {}

  Coefficients at(double alpha, Coefficients& slope) const override {
    slope = {slope_ * std::cos(alpha - zero_lift_), 0.0, 0.0};
    return {slope_ * std::sin(alpha - zero_lift_), drag_, moment_};
  }

  std::optional<double> good_to() const override { return std::numbers::pi / 12.0; }

 private:
  double slope_, zero_lift_, drag_, moment_;
};

}  // namespace

void register_thin(AirfoilRegistry& registry) {
  registry.add(
      "Thin",
      Schema("Thin", "A thin airfoil that never stalls: lift 'Slope' sin(alpha - 'Zero Lift').")
          .add(number("Slope", "1/rad", "Of the lift at zero lift; 2 pi is that of theory.")
                   .positive()
                   .optional(2.0 * std::numbers::pi))
          .add(number("Zero Lift", "rad", "Angle without lift.").optional(0.0))
          .add(number("Drag", "1", "Coefficient of drag.").at_least(0.0).optional(0.0))
          .add(number("Moment", "1", "Coefficient of the moment about the quarter chord, nose up.")
                   .optional(0.0)),
      [](const Options& options) {
        return std::make_shared<Thin>(options.number("Slope"), options.number("Zero Lift"),
                                      options.number("Drag"), options.number("Moment"));
      });
}

}  // namespace culm::strip
