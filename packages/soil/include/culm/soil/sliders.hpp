/// Soil that remembers: a curve as springs that slide.
#pragma once

#include <culm/math/types.hpp>
#include <culm/soil/curve.hpp>

#include <optional>
#include <span>
#include <vector>

namespace culm::soil {

/// A spring that slides when its force is at its limit.
struct Slider {
  double stiffness = 0.0;  ///< [N/m^2], or [N/m] of a tip
  double limit = 0.0;      ///< [N/m], [N]; infinite where it never slides
};

/// The springs in parallel that follow a curve from knot to knot when loaded for the first time,
/// and after a turn twice its shape, as Masing found; none where the curve bends upward or falls.
/// @source Iwan, Journal of Applied Mechanics 34 (1967) 612-617
std::optional<std::vector<Slider>> sliders_of(const Curve& curve);

/// What sliders do in a step.
struct SliderResponse {
  Vec3 force = Vec3::Zero();       ///< against the displacement, at theta
  Mat3 derivative = Mat3::Zero();  ///< by the displacement at the end
  double slid = 0.0;               ///< work of sliding, >= 0 at theta = 1/2
};

/// From one displacement to another with the slips before, which are moved to those after it. The
/// limit is obeyed at the end of the step, and the force at theta = 1/2 is the mean of both ends:
/// its work is the change of the energy and what is slid, which is never negative.
SliderResponse slide(std::span<const Slider> sliders, const Vec3& prev, const Vec3& next,
                     double theta, std::span<Vec3> slips);

/// Energy of the springs.
double energy_of(std::span<const Slider> sliders, const Vec3& displacement,
                 std::span<const Vec3> slips);

}  // namespace culm::soil
