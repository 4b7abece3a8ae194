/// What a section that is no shape looks like.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/math/types.hpp>

#include <vector>

namespace culm::material {

/// Parameter "Outline": corners of a polygon that encloses an area.
Schema outline_schema();
/// Its corners, counter-clockwise whichever way round they were given; none if it was not.
std::vector<Vec<2>> read_outline(const Options& options);

}  // namespace culm::material
