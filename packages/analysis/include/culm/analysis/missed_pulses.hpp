/// Pulses of loads that are shorter than a step, and turns within steps.
#pragma once

#include <culm/base/findings.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/model/model.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace culm::analysis {

/// Warns once of each function that rises and falls within one step, so that a scheme that sees it
/// at one time of the step takes a part of it or nothing. Functions without known corners, such as
/// sines and formulas, are looked at in some points of each step: a sine is told where a period has
/// two and a half steps or less. And of each function that has come back to rest while a quarter of
/// its impulse or more is lost, as of a pulse about the end of a step, or too much.
class MissedPulses {
 public:
  /// Of a function up to a time [s]: the factor of a load times how long it acts.
  struct Impulse {
    double given = 0.0;  ///< as the function has it
    double taken = 0.0;  ///< by steps, from their middles
    double size = 0.0;   ///< of the absolute value
    double lost() const { return std::abs(given - taken); }
    Impulse& operator+=(const Impulse& other);
  };

  /// Of the functions of a model, and of what else varies in time.
  explicit MissedPulses(const model::Model& model);

  /// Looks at the step from `start` to `end` [s]; the first call is for the first step of a motion.
  void check(double start, double end, Findings& findings);

  /// Looks at a step of statics, where turns count if something remembers its way: warns once of
  /// each function that goes beyond what it is at both ends of the step.
  void check_turns(double start, double end, Findings& findings);

  /// Whether a step takes another impulse of a function without known corners than that has: by a
  /// hundredth of its largest value over a usual step [s] where it jumps, by a tenth where the step
  /// is longer than that. Adaptive steps see what begins in them only there. Remembers nothing.
  bool are_lost(double start, double end, double usual) const;

  /// What was told already, under "pulses/".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  struct Candidate {
    std::string name;  // "function 'name'"
    model::Amplitude function;
    double size;  // of the values at the corners, or of those seen so far
    Impulse impulse;
    bool is_told = false;
  };
  std::vector<Candidate> candidates_;
  bool is_first_ = true;
};

}  // namespace culm::analysis
