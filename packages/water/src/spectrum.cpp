#include <culm/water/spectrum.hpp>

#include <cmath>

namespace culm::water {

double jonswap(const SeaState& sea, double frequency) {
  if (frequency <= 0.0) return 0.0;
  const double x = frequency * sea.period;
  const double width = x <= 1.0 ? 0.07 : 0.09;
  const double off = (x - 1.0) / width;
  const double grown = 0.3125 * sea.height * sea.height * sea.period * std::pow(x, -5.0) *
                       std::exp(-1.25 * std::pow(x, -4.0));
  return (1.0 - 0.287 * std::log(sea.peak)) * grown *
         std::pow(sea.peak, std::exp(-0.5 * off * off));
}

double usual_peak(double height, double period) {
  const double steepness = period / std::sqrt(height);
  if (steepness <= 3.6) return 5.0;
  if (steepness >= 5.0) return 1.0;
  return std::exp(5.75 - 1.15 * steepness);
}

}  // namespace culm::water
