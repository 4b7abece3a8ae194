#include <culm/control/pi_controller.hpp>

#include "fields.hpp"

#include <cmath>
#include <memory>

namespace culm::control {

void PiController::evaluate(const Unknowns& x, const Inputs& u, Values& values) const {
  const double error = set_point_ * u[1] - u[0];
  const double wanted = proportional_ * error + x[1];
  const double slope = output_.slope(wanted);
  values.f[0] = output_.hold(wanted);
  values.f[1] = integral_ * error + (output_.hold(wanted) - wanted) / tracking_;
  values.by_unknown(0, 1) = slope;
  values.by_unknown(1, 1) = (slope - 1.0) / tracking_;
  const double by_error[] = {slope * proportional_,
                             integral_ + (slope - 1.0) / tracking_ * proportional_};
  for (Eigen::Index k = 0; k < 2; ++k) {
    values.by_input(k, 0) = -by_error[k];
    values.by_input(k, 1) = set_point_ * by_error[k];
  }
}

void register_pi_controller(SignalRegistry& registry) {
  Schema schema("PI Controller",
                "P e + I int e dt of the error e of a signal, set point less signal; it does not "
                "wind up at its limits.");
  schema.add(text("Signal", "What is measured."))
      .add(number("Set Point", "1", "What it shall be, in its unit.").optional(0.0))
      .add(text("Set Point Function", "Function or signal that the set point is times.")
               .optional("Constant"))
      .add(number("Proportional Gain", "1", "P, in units of the output per unit of the signal.")
               .optional(0.0))
      .add(number("Integral Gain", "1/s", "I, likewise.").optional(0.0))
      .add(
          number("Tracking Time", "s",
                 "In which the integral comes back from beyond the limits; |P / I| if absent, or 1 "
                 "s where that is zero.")
              .positive()
              .optional());
  add_limits(schema);
  add_start(schema);
  registry.add("PI Controller", schema, [](const Options& options, ControlContext& context) {
    const double P = options.number("Proportional Gain");
    const double I = options.number("Integral Gain");
    double tracking = P != 0.0 && I != 0.0 ? std::abs(P / I) : 1.0;
    if (options.has("Tracking Time")) tracking = options.number("Tracking Time");
    context.add(options,
                std::make_unique<PiController>(options.number("Set Point"), P, I, tracking,
                                               read_limits(options), options.number("Scale")),
                {"Signal", "Set Point Function"}, read_start(options));
  });
}

}  // namespace culm::control
