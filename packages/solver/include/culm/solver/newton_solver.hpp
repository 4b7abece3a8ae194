/// Newton's method for one step, by NOX.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/solver/level_condition.hpp>
#include <culm/solver/linear_solver.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace culm::solver {

/// When the tangent is assembled and factored.
enum class Refresh {
  every_iteration,
  on_slow_convergence,  ///< factors serve until the residual falls too slowly (modified Newton)
};

/// How an iteration is judged and steered.
struct NewtonSettings {
  double force_tolerance = 1e-10;       ///< largest force residual over the force scale [-]
  double constraint_tolerance = 1e-11;  ///< largest |h|, lengths over the model's length [-]
  int max_iterations = 25;
  bool extrapolate_stress = true;  ///< stress prediction for the geometric part (formulation 5.2)
  Refresh refresh = Refresh::every_iteration;
  bool backtrack = false;  ///< shorten steps that increase the residual
};

/// Why a step ended.
enum class StepEnd {
  converged,
  too_many_iterations,
  diverged,        ///< increments or residual beyond any use
  singular,        ///< the tangent has no inverse
  not_finite,      ///< NaN or infinity
  out_of_range,    ///< an element or law left its domain
  turned_too_far,  ///< solved, but a node turned too far to be trusted
  off_path,        ///< solved, but not by a point that continues the path
  inaccurate,      ///< solved, but with an error far above the tolerance
};

/// One line of the convergence history.
struct IterationRecord {
  double force = 0.0;       ///< force residual over the force scale [-]
  double constraint = 0.0;  ///< largest constraint violation [-]
};

/// Not converging is a value, because a smaller step may follow.
struct StepOutcome {
  StepEnd end = StepEnd::converged;
  int iterations = 0;
  std::vector<IterationRecord> history;
  assembly::Evaluation last;
  /// Global number of the force row that rounding holds above the tolerance, the largest of them;
  /// none where the tolerance is met.
  std::optional<int> held_unknown;
  /// Of the first and of the last tangent of a static step: that at the equilibrium from which it
  /// starts, and one close to that at which it ends. Unknown in dynamics and where old factors
  /// served.
  Determinant first_determinant, last_determinant;
  bool converged() const { return end == StepEnd::converged; }
};

/// A sentence for messages.
std::string describe(StepEnd end);

/// Solves the equations of one step after the other; made once per analysis.
class NewtonSolver {
 public:
  NewtonSolver(assembly::System& system, LinearSolver& linear, const NewtonSettings& settings,
               Ledger& ledger);
  ~NewtonSolver();

  /// Solves for state.next and the multipliers, starting from their values.
  /// prepare of the system must have been called for the step. On failure state holds the last
  /// iterate.
  /// @param condition makes the level an unknown, too; none: it stays as it is
  StepOutcome solve(model::State& state, const Stencil& stencil,
                    LevelCondition* condition = nullptr);

  /// Whether the first tangent of a static step resists a little what nothing else resists, as the
  /// swinging of a rod that hangs from a hinge before it carries its weight. Equilibrium is judged
  /// as ever; whether the state that is found is a stable one remains to be seen.
  void hold_free(bool holds);

  /// What it has learned so far belongs to the step that was just ended.
  void keep();
  /// Forgets what was learned since, as if the attempts after keep() had not been made.
  void go_back();

  /// What the linear solver keeps, and the tangent whose factors serve on, if there is one, under
  /// "newton/". Collective where the snapshot is for files, which is complete on the root.
  void save(Snapshot& snapshot) const;
  /// Factors it again. With another number of ranks the next step begins with a new tangent.
  void restore(const Snapshot& snapshot);

 private:
  struct Nox;
  std::unique_ptr<Nox> nox_;
};

}  // namespace culm::solver
