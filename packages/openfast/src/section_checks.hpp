/// What a 6x6 stiffness and mass of a section must be.
#pragma once

#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/report.hpp>

namespace culm::openfast {

/// Checks that all matrices are symmetric and positive definite, and that those of the mass are of
/// a plane section. Throws InputError for the first that is not; tells the report the margins, and
/// names what contradicts itself but can be used.
void check_stations(BeamDynBlade& blade, Report& report);

}  // namespace culm::openfast
