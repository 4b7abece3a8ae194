#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

namespace culm::control {

/// An actuator of second order, y'' + 2 zeta omega y' + omega^2 (y - u) = 0, with the command u
/// held between limits and the rate v = y' between +- r: written as a lag of the rate behind the
/// one that is wanted,
///   dy/dt = v     dv/dt = 2 zeta omega (hold(omega / (2 zeta) (u - y)) - v),
/// so that the rate never leaves its limits; the output may overshoot its own where zeta < 1.
class Actuator final : public Block {
 public:
  /// @param omega  [rad/s]  @param zeta  damping ratio, positive
  Actuator(double omega, double zeta, const Limits& rate, const Limits& command, double scale)
      : omega_(omega), zeta_(zeta), rate_(rate), command_(command), scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::first_order, scale_},
            {"rate", model::UnknownKind::first_order, scale_ * omega_}};
  }
  void evaluate(const Unknowns& x, const Inputs& u, Values& values) const override;
  double start(const Inputs& u) const override { return command_.hold(u[0]); }
  double fastest() const override;

 private:
  double omega_, zeta_;
  Limits rate_, command_;
  double scale_;
};

/// Actuator
void register_actuator(SignalRegistry& registry);

}  // namespace culm::control
