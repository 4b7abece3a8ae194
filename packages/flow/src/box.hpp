/// Flows that carry a grid of velocities along with the mean wind.
#pragma once

#include "turbulence_grid.hpp"
#include "types.hpp"
#include "wind_axes.hpp"

namespace culm::flow {

/// Parameters "Density", "Centre", "Delay", "Outside" and those of WindAxes.
Schema box_schema(const std::string& name, const std::string& doc);

/// A box whose middle moves through `centre`. The first plane is there at the time -delay.
SharedFlow make_box(const Options& options, TurbulenceGrid grid);

}  // namespace culm::flow
