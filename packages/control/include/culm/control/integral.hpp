#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

namespace culm::control {

/// dy/dt = g u: the angle that belongs to an angular velocity, with all full turns.
class Integral final : public Block {
 public:
  Integral(double gain, double scale) : gain_(gain), scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::first_order, scale_}};
  }
  void evaluate(const Unknowns&, const Inputs& u, Values& values) const override {
    values.f[0] = gain_ * u[0];
    values.by_input(0, 0) = gain_;
  }
  double start(const Inputs&) const override { return 0.0; }

 private:
  double gain_;
  double scale_;
};

/// Integral
void register_integral(SignalRegistry& registry);

}  // namespace culm::control
