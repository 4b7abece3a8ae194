/// What decks say of paths.
#pragma once

#include <culm/analysis/path_condition.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/solver/newton_solver.hpp>

#include <optional>
#include <string>

namespace culm::analysis {

/// What to do at a bifurcation.
enum class AtBifurcation { report, stop, follow };

/// The node that a path is seen by.
struct WatchSettings {
  Where node_where;
  std::string node;
  Vec3 direction = Vec3::UnitX();
};

/// How a path is followed.
struct PathSettings {
  PathControl control = PathControl::linearised_sphere;
  double start_level = 0.0;
  /// First change of the level [-]; with displacement control of the displacement [m].
  double first_increment = 0.1;
  int desired_iterations = 5;
  double smallest_length = 1e-6;  ///< over the first one [-]
  double largest_length = 10.0;   ///< likewise
  int steps = 200;                ///< at most
  std::optional<double> final_level;
  std::optional<double> final_displacement;  ///< of the watched node [m]
  std::optional<int> limit_points;           ///< to end after
  std::optional<WatchSettings> watch;
  AtBifurcation at_bifurcation = AtBifurcation::report;
  std::optional<double> branch_amplitude;  ///< [m]; the present arc length if absent
  solver::NewtonSettings newton;
};

/// The entry of a deck, and what it says.
Schema path_schema();
PathSettings read_path_settings(const Options& options);

}  // namespace culm::analysis
