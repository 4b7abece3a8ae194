/// What a deck must keep when a run goes on with it.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/base/options.hpp>

#include <cstddef>
#include <set>
#include <string>

namespace culm::simulation {

/// Differences between the deck of a run and the one to go on with that would make another model
/// or another past. Free are the title, the output but its history, the analyses still to come, and
/// of the present analysis everything but type and scheme; of those before it the Newton iteration.
/// @param analysis  number of the present analysis
/// @param time      what it has reached
/// @param returns   types of analyses whose time or level may fall
InputIssues find_forbidden_changes(const Options& before, const Options& now, std::size_t analysis,
                                   double time, const std::set<std::string>& returns);

}  // namespace culm::simulation
