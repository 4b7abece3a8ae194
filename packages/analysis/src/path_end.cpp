#include "path_end.hpp"

#include <culm/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace culm::analysis {

std::string name_targets(const PathSettings& settings) {
  std::vector<std::string> targets;
  if (settings.final_level) targets.push_back(fmt::format("level {:g}", *settings.final_level));
  if (settings.final_displacement) {
    targets.push_back(fmt::format("displacement {:g} m of '{}'", *settings.final_displacement,
                                  settings.watch->node));
  }
  if (settings.limit_points) {
    targets.push_back(fmt::format("limit point {}", *settings.limit_points));
  }
  if (settings.at_bifurcation == AtBifurcation::stop) targets.emplace_back("a bifurcation");
  return join(targets, " or ");
}

std::string explain_missing_steps(const PathSettings& settings, const PathPace& pace, double size,
                                  std::size_t events) {
  constexpr double out_of_reach = 100.0;  // times those that the deck allows
  std::optional<double> missing;
  if (settings.final_level) missing = pace.steps_to_level(*settings.final_level);
  if (settings.final_displacement) {
    const auto more = pace.steps_to_displacement(*settings.final_displacement);
    missing = missing && more ? std::min(*missing, *more) : more;
  }
  if (!missing) return {};
  if (*missing < out_of_reach * settings.steps) {
    return fmt::format("; at the pace of the last {} it takes {:.0f} more", PathPace::steps,
                       *missing);
  }
  std::string text = fmt::format("; the last {} lead no nearer to it", PathPace::steps);
  constexpr double tiny = 0.1;
  if (size < tiny) {
    text += fmt::format(
        ", and steps are {:.2g} times as long as the first: a path that turns so sharply mostly "
        "has a mesh too coarse for its waves",
        size);
  }
  if (events > 0) {
    text += fmt::format("; limit points, turning points and bifurcations on the way: {}", events);
  }
  return text;
}

}  // namespace culm::analysis
