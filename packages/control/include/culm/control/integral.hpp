#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

namespace culm::control {

/// dy/dt = g u + (hold(y) - y) / T: the angle that belongs to an angular velocity, with all full
/// turns; or an integral that limits hold, to T times what drives it beyond.
class Integral final : public Block {
 public:
  /// @param tracking  T [s], of no importance without limits
  Integral(double gain, double scale, const Limits& output = {}, double tracking = 1.0)
      : gain_(gain), scale_(scale), output_(output), tracking_(tracking) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::first_order, scale_}};
  }
  void evaluate(const Unknowns& x, const Inputs& u, Values& values) const override {
    values.f[0] = gain_ * u[0] + (output_.hold(x[0]) - x[0]) / tracking_;
    values.by_unknown(0, 0) = (output_.slope(x[0]) - 1.0) / tracking_;
    values.by_input(0, 0) = gain_;
  }
  double start(const Inputs&) const override { return output_.hold(0.0); }

 private:
  double gain_;
  double scale_;
  Limits output_;
  double tracking_;
};

/// Integral
void register_integral(SignalRegistry& registry);

}  // namespace culm::control
