#include <culm/analysis/newton_options.hpp>
#include <culm/analysis/path_settings.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace culm::analysis {
namespace {

const std::vector<std::pair<std::string, PathControl>>& controls() {
  static const std::vector<std::pair<std::string, PathControl>> names = {
      {"Linearised Sphere", PathControl::linearised_sphere},
      {"Normal Plane", PathControl::normal_plane},
      {"Sphere", PathControl::sphere},
      {"Displacement", PathControl::displacement}};
  return names;
}

const std::vector<std::pair<std::string, AtBifurcation>>& bifurcation_choices() {
  static const std::vector<std::pair<std::string, AtBifurcation>> names = {
      {"Report", AtBifurcation::report},
      {"Stop", AtBifurcation::stop},
      {"Follow", AtBifurcation::follow}};
  return names;
}

template <class Value>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  return names;
}

template <class Value>
Value value_of(const std::string& chosen,
               const std::vector<std::pair<std::string, Value>>& choices) {
  return std::find_if(choices.begin(), choices.end(),
                      [&](const auto& choice) { return choice.first == chosen; })
      ->second;
}

Schema watch_schema() {
  return Schema("Watch", "The displacement that a path is seen by.")
      .add(text("Node", "The node, such as 'structure/last'."))
      .add(numbers("Direction", "", "Direction of the displacement; its length does not matter.")
               .size(3))
      .add(number("Final Displacement", "m", "Displacement at which the path ends.").optional());
}

void check_path(const Options& options, InputIssues& issues) {
  if (options.number("First Increment") == 0.0) {
    issues.add(options.where("First Increment"), "must not be 0");
  }
  if (!options.has_list("Watch")) {
    if (options.text("Control") == "Displacement") {
      issues.add(options.where("Control"),
                 "displacement control needs a list 'Watch' with the node and the direction");
    }
    return;
  }
  const Options& watch = options.list("Watch");
  const std::vector<double>& direction = watch.numbers("Direction");
  if (std::all_of(direction.begin(), direction.end(), [](double d) { return d == 0.0; })) {
    issues.add(watch.where("Direction"), "must not be zero");
  }
}

}  // namespace

Schema path_schema() {
  const PathSettings defaults;
  return Schema("Path",
                "Equilibrium path through limit points, by arc length or displacement control.")
      .add(choice("Control", names_of(controls()),
                  "The condition that a step fulfils: of three on the length of its way, or a "
                  "displacement of the watched node. All trace the same path.")
               .optional("Linearised Sphere"))
      .add(number("First Increment", "",
                  "Change of the level in the first step, negative to begin with a falling level; "
                  "with Control = Displacement the displacement of the watched node [m].")
               .optional(defaults.first_increment))
      .add(number("Start Level", "1", "Level at which the path begins.")
               .optional(defaults.start_level))
      .add(number("Final Level", "1", "Level at which the path ends when it first gets there.")
               .optional())
      .add(integer("Limit Points", "Number of limit points after which the path ends.")
               .at_least(1)
               .optional())
      .add(integer("Steps", "Number of steps after which the path ends.")
               .at_least(1)
               .optional(defaults.steps))
      .add(integer("Desired Iterations",
                   "Steps with more iterations make the next one shorter, others longer.")
               .at_least(1)
               .optional(defaults.desired_iterations))
      .add(number("Smallest Length", "1", "Bound on steps, over the length of the first one.")
               .positive()
               .optional(defaults.smallest_length))
      .add(number("Largest Length", "1", "Bound on steps, over the length of the first one.")
               .positive()
               .optional(defaults.largest_length))
      .add(choice("Bifurcation", names_of(bifurcation_choices()),
                  "What to do where another path crosses: report it, end, or go on on the first "
                  "one that does.")
               .optional("Report"))
      .add(
          number(
              "Branch Amplitude", "m",
              "First distance from the old path when another is followed, a root mean square "
              "over all nodes; a negative one makes the watched displacement fall. The length of a "
              "step if absent.")
              .optional())
      .list("Watch", watch_schema(), Presence::optional)
      .list("Newton", newton_schema(), Presence::defaulted)
      .check(check_path);
}

PathSettings read_path_settings(const Options& options) {
  PathSettings settings;
  settings.control = value_of(options.text("Control"), controls());
  settings.start_level = options.number("Start Level");
  settings.first_increment = options.number("First Increment");
  settings.desired_iterations = options.integer("Desired Iterations");
  settings.smallest_length = options.number("Smallest Length");
  settings.largest_length = options.number("Largest Length");
  settings.steps = options.integer("Steps");
  if (options.has("Final Level")) settings.final_level = options.number("Final Level");
  if (options.has("Limit Points")) settings.limit_points = options.integer("Limit Points");
  settings.at_bifurcation = value_of(options.text("Bifurcation"), bifurcation_choices());
  if (options.has("Branch Amplitude")) {
    settings.branch_amplitude = options.number("Branch Amplitude");
  }
  if (options.has_list("Watch")) {
    const Options& watch = options.list("Watch");
    const std::vector<double>& direction = watch.numbers("Direction");
    settings.watch = WatchSettings{watch.where("Node"), watch.text("Node"),
                                   Vec3(direction[0], direction[1], direction[2]).normalized()};
    if (watch.has("Final Displacement")) {
      settings.final_displacement = watch.number("Final Displacement");
    }
  }
  settings.newton = newton_settings(options.list("Newton"));
  return settings;
}

}  // namespace culm::analysis
