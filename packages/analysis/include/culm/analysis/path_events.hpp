/// Limit points and bifurcations between two points of an equilibrium path.
#pragma once

#include <culm/analysis/path_condition.hpp>
#include <culm/solver/linear_solver.hpp>

#include <string>
#include <vector>

namespace culm::analysis {

/// An equilibrium on a path.
struct PathPoint {
  double level = 0.0;
  double watched = 0.0;  ///< displacement of the watched node [m]
  PathTangent tangent;
  solver::Determinant determinant;  ///< of the tangent stiffness
  bool sets_energy_free = false;    ///< in its softest direction
};

enum class PathEventKind {
  limit_point,    ///< the level turns
  turning_point,  ///< the watched displacement turns
  bifurcation,    ///< another path crosses
};

/// Where something happens on a path, by interpolation between two points.
struct PathEvent {
  PathEventKind kind = PathEventKind::limit_point;
  double level = 0.0;
  double watched = 0.0;  ///< [m]
  double length = 0.0;   ///< of arc from the point before it, as near as find_events() knows [m]
};

/// "limit point", "turning point", "bifurcation"
std::string name_of(PathEventKind kind);

/// What lies between two points that are `length` [m] of arc apart, in their order on the path.
/// Level and displacement are cubic between them. Where the level turns, one eigenvalue of the
/// stiffness passes zero and the determinant changes its sign; where the determinant does so alone,
/// or does not although the level turns, there is a bifurcation.
std::vector<PathEvent> find_events(const PathPoint& from, const PathPoint& to, double length);

}  // namespace culm::analysis
