#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

namespace culm::control {

/// A proportional and integral controller of the error e = s - u of a measured signal u against its
/// set point s = S u_2,
///   y = hold(w)     w = P e + z     dz/dt = I e + (y - w) / T.
/// The last term, zero between the limits, keeps the integral from winding up beyond them.
/// @source Astrom, Hagglund, Advanced PID Control (2006), 3.5: back-calculation
class PiController final : public Block {
 public:
  /// @param set_point  S  @param tracking  T [s]
  PiController(double set_point, double proportional, double integral, double tracking,
               const Limits& output, double scale)
      : set_point_(set_point),
        proportional_(proportional),
        integral_(integral),
        tracking_(tracking),
        output_(output),
        scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::algebraic, scale_},
            {"integral", model::UnknownKind::first_order, scale_}};
  }
  /// @param u  the measured signal, and what the set point is times
  void evaluate(const Unknowns& x, const Inputs& u, Values& values) const override;
  int state() const override { return 1; }
  double start(const Inputs&) const override { return 0.0; }

 private:
  double set_point_, proportional_, integral_, tracking_;
  Limits output_;
  double scale_;
};

/// PI Controller
void register_pi_controller(SignalRegistry& registry);

}  // namespace culm::control
