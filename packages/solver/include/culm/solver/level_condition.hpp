/// A level that is unknown, with the equation that it takes.
#pragma once

#include <culm/assembly/system.hpp>

namespace culm::solver {

/// Makes state.time, the level of loads and prescribed motions, an unknown of a static step. With
/// d_R = -J^-1 R and d_f = -J^-1 dR/dlevel an iteration moves the state by d_R + dlevel d_f; the
/// condition chooses dlevel. All functions are collective. @source formulation 5.3
class LevelCondition {
 public:
  virtual ~LevelCondition() = default;
  /// Difference of levels for dR/dlevel; negative where the level falls.
  virtual double level_difference() const = 0;
  /// Change of the level in an iteration that starts at state.next.
  /// @param response d_R @param flexibility d_f @return not finite if there is none
  virtual double level_increment(const model::State& state, const assembly::Vector& response,
                                 const assembly::Vector& flexibility) = 0;
  /// How far the condition is from being met, a length over that of the model [-].
  virtual double violation(const model::State& state) = 0;
};

}  // namespace culm::solver
