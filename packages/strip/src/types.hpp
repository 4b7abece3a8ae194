/// One function per type of airfoil.
#pragma once

#include <culm/strip/airfoil.hpp>

namespace culm::strip {

void register_thin(AirfoilRegistry& registry);
void register_polar(AirfoilRegistry& registry);

}  // namespace culm::strip
