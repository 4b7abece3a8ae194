/// A model as pictures show it before anything is solved.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/output/recorder.hpp>

#include <filesystem>

namespace culm::simulation {

/// Writes a result file with nothing but the reference: structures, constraints, each load as it
/// acts at the time between 0 and `end` at which it is largest, and as arrays `link: TYPE: NAME`
/// both ends of springs, dampers, drives and mooring lines. Collective; throws FileError.
/// @param end  time [s] at which the first analysis ends, or level
void draw_model(const assembly::System& system, const output::RunInfo& info, double end,
                const std::filesystem::path& path);

}  // namespace culm::simulation
