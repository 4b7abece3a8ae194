/// How long waves of a period are.
#pragma once

namespace culm::water {

/// The number k of waves [rad/m] with omega^2 = g k tanh k d, to rounding.
/// @param frequency  omega [rad/s]  @pre > 0
/// @param depth      d [m]          @pre > 0
/// @param gravity    g [m/s^2]      @pre > 0
double wave_number(double frequency, double depth, double gravity);
/// Waves of a number k that are higher than this have broken [m].
/// @source Miche (1944): H < 0.142 L tanh kd
double breaking_height(double number, double depth);

}  // namespace culm::water
