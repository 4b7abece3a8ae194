/// Why time steps were cut back, for the end of a motion.
#pragma once

#include <culm/base/snapshot.hpp>
#include <culm/solver/newton_solver.hpp>

#include <array>
#include <string>

namespace culm::analysis {

/// Counts attempts and what was seen where they failed. Where many did, says what the step should
/// be, or what is in its way.
class CutBacks {
 public:
  /// After an accepted step. @param taken its length [s] @param turn largest of a node in it [rad]
  void accept(double taken, double turn);
  /// After an attempt that failed. @param reversal  Predictor::reversal
  void reject(solver::StepEnd reason, double reversal);

  /// The hint; empty where less than a twentieth of the attempts failed.
  /// @param step of the deck [s]
  std::string hint(double step) const;

  /// The counts, under "cut-backs".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  static constexpr std::size_t num_reasons = 9;  ///< of solver::StepEnd

  double accepted_ = 0.0;
  double rejected_ = 0.0;
  double least_taken_ = 1e300;  ///< shortest step that was accepted [s]
  double largest_turn_ = 0.0;   ///< of accepted steps [rad]
  double reversals_ = 0.0;      ///< sum
  std::array<double, num_reasons> reasons_{};
};

}  // namespace culm::analysis
