/// What all analyses share.
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
  /// Called before step, for each attempt on the way there that is not shown by itself, as within a
  /// window of a coupling.
  virtual void pass(const StepReport& report) { (void)report; }
  /// Called at the end, with what the analysis says.
  virtual void finish(const AnalysisReport& report, const model::State& state) {
    (void)report;
    (void)state;
  }
  /// What has been seen so far, for go_back; between steps.
  virtual void keep(Snapshot& snapshot) const { (void)snapshot; }
  /// Forgets what was seen since. Throws UsageError, and forgets nothing, where it was kept by
  /// another observer.
  virtual void go_back(const Snapshot& kept) { (void)kept; }
};

/// An analysis that makes no steps: it looks at a state, which it may bring to a level of its own.
class Inspection {
 public:
  virtual ~Inspection() = default;
  /// What inspect does first: throws where nothing can be found, as of a mechanism.
  virtual void begin(Context&, model::State&) {}
  /// After begin.
  virtual AnalysisReport inspect(Context& context, model::State& state) = 0;
};

}  // namespace culm::analysis
