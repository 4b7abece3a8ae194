/// OpenFAST's angles are in degrees.
#pragma once

#include <numbers>

namespace culm::openfast {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< [rad]

}  // namespace culm::openfast
