#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

#include <limits>

namespace culm::control {

/// A proportional and integral controller of the error e = s - u of a measured signal u against its
/// set point s = S u_2,
///   y = hold(w)     w = G P e + z     dz/dt = G I e + (y - w) / T.
/// The last term, zero between the limits, keeps the integral from winding up beyond them. Gains
/// may follow a third signal v, G = 1 / (1 + v / V) for v >= 0 and 1 below, else G = 1; the
/// integral holds what was gained, so the output does not jump with them.
/// @source Astrom, Hagglund, Advanced PID Control (2006), 3.5: back-calculation; Jonkman et al.,
///   NREL/TP-500-38060 (2009), eq. (7-15): the schedule of gains by the pitch angle
class PiController final : public Block {
 public:
  /// @param set_point  S  @param tracking  T [s]  @param halved_at  V, where G is one half
  PiController(double set_point, double proportional, double integral, double tracking,
               const Limits& output, double scale,
               double halved_at = std::numeric_limits<double>::infinity())
      : set_point_(set_point),
        proportional_(proportional),
        integral_(integral),
        tracking_(tracking),
        output_(output),
        scale_(scale),
        halved_at_(halved_at) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::algebraic, scale_},
            {"integral", model::UnknownKind::first_order, scale_}};
  }
  /// @param u  the measured signal, what the set point is times, and what gains follow, if they do
  void evaluate(const Unknowns& x, const Inputs& u, Values& values) const override;
  int state() const override { return 1; }
  double start(const Inputs&) const override { return 0.0; }

 private:
  double set_point_, proportional_, integral_, tracking_;
  Limits output_;
  double scale_;
  double halved_at_;
};

/// PI Controller
void register_pi_controller(SignalRegistry& registry);

}  // namespace culm::control
