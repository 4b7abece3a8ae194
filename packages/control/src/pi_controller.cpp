#include <culm/control/pi_controller.hpp>

#include "fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace culm::control {

void PiController::evaluate(const Unknowns& x, const Inputs& u, Values& values) const {
  const bool is_scheduled = u.size() > 2;
  const double beyond = is_scheduled ? std::max(u[2], 0.0) / halved_at_ : 0.0;
  const double gain = 1.0 / (1.0 + beyond);
  const double P = gain * proportional_;
  const double I = gain * integral_;
  const double error = set_point_ * u[1] - u[0];
  const double wanted = P * error + x[1];
  const double slope = output_.slope(wanted);
  values.f[0] = output_.hold(wanted);
  values.f[1] = I * error + (output_.hold(wanted) - wanted) / tracking_;
  values.by_unknown(0, 1) = slope;
  values.by_unknown(1, 1) = (slope - 1.0) / tracking_;
  // of both equations by the error, and by the factor of the gains
  const auto by = [&](Eigen::Index input, double p, double i, double inner) {
    values.by_input(0, input) = slope * p * inner;
    values.by_input(1, input) = (i + (slope - 1.0) / tracking_ * p) * inner;
  };
  by(0, P, I, -1.0);
  by(1, P, I, set_point_);
  if (!is_scheduled) return;
  const double by_signal = u[2] > 0.0 ? -gain * gain / halved_at_ : 0.0;
  by(2, proportional_, integral_, error * by_signal);
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
      .add(text("Schedule Signal",
                "Function or signal v that gains follow: they are P and I over 1 + v / 'Halved At' "
                "for v >= 0, and P and I below.")
               .optional())
      .add(number("Halved At", "1", "The value of it at which gains are half of P and I.")
               .positive()
               .optional())
      .add(
          number("Tracking Time", "s",
                 "In which the integral comes back from beyond the limits; |P / I| if absent, or 1 "
                 "s where that is zero.")
              .positive()
              .optional());
  schema.check([](const Options& options, InputIssues& issues) {
    if (options.has("Schedule Signal") == options.has("Halved At")) return;
    issues.add(options.where(), "'Schedule Signal' and 'Halved At' need each other");
  });
  add_limits(schema);
  add_start(schema);
  registry.add("PI Controller", schema, [](const Options& options, ControlContext& context) {
    const double P = options.number("Proportional Gain");
    const double I = options.number("Integral Gain");
    double tracking = P != 0.0 && I != 0.0 ? std::abs(P / I) : 1.0;
    if (options.has("Tracking Time")) tracking = options.number("Tracking Time");
    std::vector<std::string> inputs = {"Signal", "Set Point Function"};
    double halved_at = std::numeric_limits<double>::infinity();
    if (options.has("Schedule Signal")) {
      inputs.emplace_back("Schedule Signal");
      halved_at = options.number("Halved At");
    }
    context.add(
        options,
        std::make_unique<PiController>(options.number("Set Point"), P, I, tracking,
                                       read_limits(options), options.number("Scale"), halved_at),
        std::move(inputs), read_start(options));
  });
}

}  // namespace culm::control
