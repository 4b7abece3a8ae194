/// Where the iteration of a time step begins.
#pragma once

#include <culm/analysis/velocity_rows.hpp>
#include <culm/assembly/system.hpp>
#include <culm/base/snapshot.hpp>

#include <deque>
#include <vector>

namespace culm::analysis {

/// First guesses of steps: on with the velocity of the start, or on the straight line through the
/// mean velocities of the last two steps where stiff vibrations that steps do not resolve make
/// velocities jump from step to step, which means do not; or on a
/// polynomial through up to four where that would have come much nearer to the last step. A smooth
/// motion is so met by one iteration. The solution does not depend on the guess.
class Predictor {
 public:
  explicit Predictor(assembly::System& system) : system_(system) {}

  /// Moves state.next from the start of the step to the guess for its end. @param step [s]
  void predict(model::State& state, double step) const;
  /// Learns from an accepted step, before state.velocity is that of its end; collective.
  void accept(const model::State& state, double step);
  /// After a step that failed: the next guess is the plain one.
  void reject() { points_ = plain(); }
  /// Cosine between the changes of velocity in successive steps, over all nodes, lately: near 1 of
  /// a motion that steps resolve, near -1 where each turns round what the one before did.
  double reversal() const { return reversal_; }
  /// Points of the polynomial that the next guess takes; 0 for the velocity of the start.
  int points() const { return points_; }

  /// What is remembered, under "predictor/"; collective.
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  using Motions = assembly::System::Motions;
  struct MeanVelocity {
    double time = 0.0;  ///< middle of the step [s]
    Motions values;     ///< [m/s, rad/s]
  };

  int plain() const { return past_.size() > 1 && reversal_ < 0.0 ? 2 : 0; }
  double reversal_of(const VelocityChanges& changes) const;
  GuessWeights weights(int points, double time) const;

  assembly::System& system_;
  std::deque<MeanVelocity> past_;  ///< the last one first
  int points_ = 0;
  double reversal_ = 1.0;
};

}  // namespace culm::analysis
