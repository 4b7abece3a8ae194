/// Winds that are given by their speed at one height.
#pragma once

#include "types.hpp"
#include "wind_axes.hpp"

#include <cmath>

namespace culm::flow {

/// Parameters "Density", "Speed", "Height", and those of WindAxes.
inline Schema reference_wind_schema(const std::string& name, const std::string& doc) {
  return Schema(name, doc)
      .add(density_field())
      .add(number("Speed", "m/s", "Speed at 'Height'.").non_negative())
      .add(number("Height", "m", "Height above the origin, along 'Up', at which 'Speed' holds.")
               .positive())
      .add_all(wind_axes_schema());
}

/// Ratio of the speeds at a height and at the reference height; none at the ground and below.
inline double power_law(double height, double reference, double exponent) {
  return height > 0.0 ? std::pow(height / reference, exponent) : 0.0;
}
/// Its derivative by the height [1/m].
inline double power_law_slope(double height, double reference, double exponent) {
  return height > 0.0 ? exponent / height * power_law(height, reference, exponent) : 0.0;
}

}  // namespace culm::flow
