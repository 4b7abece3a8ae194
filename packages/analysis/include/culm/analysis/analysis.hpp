/// What every analysis shares.
#pragma once

#include <culm/analysis/shape.hpp>
#include <culm/base/findings.hpp>
#include <culm/base/log.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/solver/newton_solver.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace culm::analysis {

/// One step as seen from outside.
struct StepReport {
  int step = 0;             ///< accepted steps so far, this one included
  double time = 0.0;        ///< load level in statics [-], time in dynamics [s]
  double final_time = 0.0;  ///< infinite where nobody knows
  double increment = 0.0;
  bool accepted = true;  ///< false: the step is tried again with a smaller increment
  solver::StepOutcome outcome;
  bool is_last = false;  ///< accepted, and the end of the analysis
};

/// Whoever wants to see each step: results, progress, a coupling harness.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Called where an analysis that was not resumed begins, when positions and velocities fit the
  /// constraints and before the first step.
  virtual void start(model::State&) {}
  /// Called after each attempt. When it was accepted, state.next is the new equilibrium, up to date
  /// on all ranks only after System::synchronise.
  virtual void step(const StepReport& report, model::State& state) = 0;
};

/// What an analysis works on. All borrowed.
struct Context {
  assembly::System& system;
  solver::LinearSolver& linear;
  Ledger& ledger;
  const Log& log;
  Findings& findings;  ///< what the user must know: `warn` and `broken` say and keep it
};

/// Numbers in rows for result files.
struct ReportTable {
  std::string name;
  std::vector<std::string> columns;  ///< names with units
  std::vector<std::vector<double>> rows;
  std::vector<std::string> remarks;  ///< one per row, or none
};

/// A sparse matrix by its entries, whole on rank 0 and empty elsewhere.
struct ReportMatrix {
  std::string name;
  int rows = 0;
  int columns = 0;
  std::vector<int> row;  ///< of each entry, from 0
  std::vector<int> column;
  std::vector<double> value;
};

/// What an analysis says at its end, beside its steps.
struct AnalysisReport {
  std::string text;
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<ReportTable> tables = {};
  std::vector<Shape> shapes = {};  ///< about the state at the end
  std::vector<ReportMatrix> matrices = {};
};

/// Makes the new equilibrium the start of the next step.
void accept(model::State& state);
/// Goes back to the start of the step.
void reject(model::State& state);

/// A way to move a state, in steps. Everything it remembers from one step to the next stands in its
/// members, where save() finds it. run() and resume() throw NumericalError or NonFiniteError with a
/// post-mortem when they have to give up; the state is then the last accepted one.
class Analysis {
 public:
  virtual ~Analysis() = default;

  AnalysisReport run(Context& context, model::State& state, Observer& observer) {
    fit(context, state);
    observer.start(state);
    start(context, state);
    return advance(context, state, observer);
  }
  /// What run() does before its first step: throws where no step can be made, as from a mechanism.
  void examine(Context& context, model::State& state) { start(context, state); }
  /// Goes on from the step in which save() was called. The state is that of then.
  AnalysisReport resume(Context& context, model::State& state, Observer& observer,
                        const Snapshot& snapshot) {
    restore(context, snapshot);
    return advance(context, state, observer);
  }
  /// Writes what the next step needs beside the state. For observers of a step; collective.
  virtual void save(const Context& context, Snapshot& snapshot) const = 0;

 private:
  /// Brings positions and velocities to where the analysis can begin.
  virtual void fit(Context&, model::State&) {}
  /// Looks at the present state and prepares the first step.
  virtual void start(Context& context, model::State& state) = 0;
  /// Takes over what save wrote. Throws FileError if it does not fit.
  virtual void restore(Context& context, const Snapshot& snapshot) = 0;
  /// Makes all steps to the end.
  virtual AnalysisReport advance(Context& context, model::State& state, Observer& observer) = 0;
};

}  // namespace culm::analysis
