/// The ground below a joint, as SubDyn's SSIfile describes it.
#pragma once

#include <culm/math/types.hpp>
#include <culm/openfast/report.hpp>

#include <filesystem>

namespace culm::openfast {

/// Stiffness and mass that the ground adds to a joint: displacements along x, y, z, rotations about
/// them.
struct Ground {
  Mat6 stiffness = Mat6::Zero();  ///< [N/m, N, N m]
  Mat6 mass = Mat6::Zero();       ///< [kg, kg m, kg m^2]
};

/// Reads lines of a value and the name of its entry, `Kxx` to `Ktztz` and `Mxx` to `Mtztz`, in any
/// order; entries that are not there are zero and told to the report. Throws InputError, FileError.
Ground read_ground(const std::filesystem::path& path, Report& report);

}  // namespace culm::openfast
