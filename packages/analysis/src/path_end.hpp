/// What a path that ran out of steps tells.
#pragma once

#include <culm/analysis/path_pace.hpp>
#include <culm/analysis/path_settings.hpp>

#include <cstddef>
#include <string>

namespace culm::analysis {

/// "level 1 or limit point 2": where the path shall end but for its number of steps; empty if that
/// is all.
std::string name_targets(const PathSettings& settings);

/// How many more steps it takes to the targets at the pace of the last ones, or why they will not
/// be reached; begins with ";", empty where that is not known.
/// @param size    of the next step over the first
/// @param events  limit points, turning points and bifurcations on the way
std::string explain_missing_steps(const PathSettings& settings, const PathPace& pace, double size,
                                  std::size_t events);

}  // namespace culm::analysis
