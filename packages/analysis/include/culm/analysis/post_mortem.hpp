/// Why a sound deck did not solve, in the user's terms.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/analysis/unknown_names.hpp>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace culm::analysis {

/// Remembers what a diagnosis needs while an analysis runs, and makes it when the analysis fails.
class PostMortem {
 public:
  /// Measures the structure at the start of the analysis, where the system has begun a step, and
  /// notes why its tangent is singular there, if it is: a mechanism or redundant constraints.
  /// Throws NonFiniteError if it is beyond the range of numbers.
  /// @param first_level a level above that of state
  PostMortem(Context& context, model::State& state, const Stencil& stencil, double first_level);
  /// The same in dynamics, where no load can be too large for an equilibrium. Throws NumericalError
  /// if the tangent is singular.
  PostMortem(Context& context, model::State& state, const Stencil& stencil);
  /// Goes on where an earlier one was, without another look at the structure.
  PostMortem(Context& context, const Snapshot& snapshot);
  /// What it measured at the start.
  void save(Snapshot& snapshot) const;

  bool is_singular() const { return !singular_.empty(); }
  /// Whether the tangent at `state` is singular as well, where the system has begun a step.
  /// Collective.
  bool is_singular(model::State& state, const Stencil& stencil);
  /// Throws NumericalError if the tangent is singular where the analysis starts.
  void refuse_singular() const;
  /// Throws NumericalError where the mass matrix, bordered by constraints, has no useful factors.
  [[noreturn]] static void refuse_massless(Context& context, const model::State& state);

  /// Adds an attempt to the history.
  void record(const StepReport& report);

  /// Throws NumericalError, or NonFiniteError if that is what happened in the last attempt. The
  /// text is the same on all ranks. @param state the last accepted state
  /// @param end  level towards which ever smaller gains lead, where they are the reason
  [[noreturn]] void give_up(model::State& state, const Stencil& stencil,
                            std::optional<double> end = {});

 private:
  /// d . p for the response K d = p to the load p of a unit level: grows without bound, then
  /// changes sign, where load control ends. Infinite when the tangent is singular.
  double load_flexibility(model::State& state, const Stencil& stencil, double level_step);
  /// Why the tangent at `state` is singular to working precision, on all ranks; empty if it is not.
  std::string find_singular(model::State& state, const Stencil& stencil);
  /// The same of the tangent at hand, factored or not, by its response to a probe.
  std::string judge(const model::State& state, const assembly::Vector& probe);
  const char* time_word() const { return level_step_ == 0.0 ? "time" : "level"; }
  std::string history() const;
  std::string worst_rows() const;
  std::string cause(model::State& state, const Stencil& stencil);
  std::string path_cause(model::State& state, const Stencil& stencil);
  /// The prescribed rotation that the last attempt would have turned too far, or null. Collective.
  const model::Constraint* turn_too_far(model::State& state, const Stencil& stencil) const;
  std::string turn_cause(const model::Constraint* turn) const;
  std::string dynamic_cause() const;

  Context& context_;
  bool is_factored_ = false;  ///< whether the tangent looked at last has factors
  double first_flexibility_ = 0.0;
  double level_step_ = 0.0;          ///< 0 in dynamics
  std::string singular_;             ///< why the first tangent is singular; empty if it is not
  std::deque<StepReport> attempts_;  ///< the last ones
  std::vector<UnknownNames::Entry> worst_;
};

}  // namespace culm::analysis
