#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

namespace culm::control {

/// An actuator of first order: dy/dt = (u - y) / T, the command u held between its limits and the
/// rate between +- r. The output cannot leave the limits.
class Lag final : public Block {
 public:
  /// @param time_constant  T [s]
  Lag(double time_constant, const Limits& rate, const Limits& command, double scale)
      : time_constant_(time_constant), rate_(rate), command_(command), scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::first_order, scale_}};
  }
  void evaluate(const Unknowns& x, const Inputs& u, Values& values) const override;
  double start(const Inputs& u) const override { return command_.hold(u[0]); }
  double fastest() const override { return 1.0 / time_constant_; }

 private:
  double time_constant_;
  Limits rate_, command_;
  double scale_;
};

/// Lag
void register_lag(SignalRegistry& registry);

}  // namespace culm::control
