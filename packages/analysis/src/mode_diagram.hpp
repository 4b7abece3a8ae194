/// Frequencies and damping over the load level.
#pragma once

#include <culm/analysis/find_modes.hpp>

#include <string>
#include <vector>

namespace culm::analysis {

/// A mode on its way through the levels.
struct Followed {
  Shape shape;
  double rate = 0.0;  ///< [rad/s]; negative beyond the speed at which a backward whirl stands still
};

/// Static equilibrium and modes at one level after the other; those of the first level are followed
/// by their shapes.
class ModeDiagram {
 public:
  /// @param title  of the table
  ModeDiagram(Context& context, const ModalSettings& modes, const solver::NewtonSettings& newton,
              std::string title);

  /// Goes to a level, up or down, and finds modes: those asked for and some more. Throws
  /// NumericalError.
  ModeSet find(model::State& state, double level);
  /// A row of the table for what was found at the level of the state.
  void add(const model::State& state, const ModeSet& set);

  /// Level, frequencies [Hz], damping ratios; empty cells where a mode is lost.
  const ReportTable& table() const { return table_; }
  /// The same for readers, with what moves at the last level.
  std::string text() const;

 private:
  void begin(const ModeSet& set);
  std::string rows_text(const char* title, std::size_t first, double unit) const;

  Context& context_;
  std::size_t asked_;
  ModalSettings settings_;
  solver::NewtonSolver newton_;
  ReportTable table_;
  std::vector<Followed> followed_;
  std::vector<std::string> meaning_;  // of the modes at the last level
  double speed_ = 0.0;                // of a turning rotor
};

}  // namespace culm::analysis
