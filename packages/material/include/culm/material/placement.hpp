/// Where a section sits on the axis of the beam; for all section types.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/material/section.hpp>

namespace culm::material {

/// `Offset` and `Angle`, which every section type has.
Schema placement_schema();

/// Turns the section by `Angle` about its own origin, then moves that origin to `Offset`.
Section place(const Section& section, const Options& options);

}  // namespace culm::material
