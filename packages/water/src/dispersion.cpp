#include <culm/water/dispersion.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace culm::water {

double wave_number(double frequency, double depth, double gravity) {
  constexpr int enough = 20;  // the first guess is within 5 %, and Newton's method is quadratic
  constexpr double rounding = 2.0 * std::numeric_limits<double>::epsilon();
  const double square = frequency * frequency / gravity;
  double k = square / std::sqrt(std::tanh(square * depth));
  for (int i = 0; i < enough; ++i) {
    const double t = std::tanh(k * depth);
    const double change = (k * t - square) / (t + k * depth * (1.0 - t * t));
    k -= change;
    if (std::abs(change) <= rounding * k) break;
  }
  return k;
}

double breaking_height(double number, double depth) {
  return 0.142 * 2.0 * std::numbers::pi / number * std::tanh(number * depth);
}

}  // namespace culm::water
