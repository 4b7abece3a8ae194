/// Mean winds that are added to boxes of fluctuations.
#pragma once

#include "types.hpp"

namespace culm::flow {

/// Parameters "Exponent" and "Roughness" of the mean wind, which the speed at "Height" goes with.
Schema mean_profile_schema();

/// A wind of this speed at "Height" [m/s], by the power law of "Exponent" or the logarithmic law of
/// "Roughness", and what the box adds to it. Reads "Density" and WindAxes, too.
SharedFlow add_mean_wind(const Options& options, double speed, SharedFlow fluctuations);

}  // namespace culm::flow
