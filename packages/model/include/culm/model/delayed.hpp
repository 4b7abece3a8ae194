/// Forces that follow motions with a delay.
#pragma once

#include <culm/model/batch.hpp>

#include <vector>

namespace culm::model {

/// Has states x of its own that follow what moves them, T x' + x = u, and no unknowns for them. A
/// linearisation condenses them: in a motion exp(s t) they miss the share f(s) = s T / (1 + s T).
class Delayed {
 public:
  virtual ~Delayed() = default;
  /// The times T of local items about a steady state [s], as many as come.
  virtual std::vector<double> delays(const State& state) const = 0;
  /// Adds to the tangent of this stencil what it gains if all states of one of these times, within
  /// `same_delay`, stand still.
  virtual Verdict assemble_delayed(const State& state, const Stencil& stencil, double delay,
                                   Target& target) = 0;
};

/// Relative difference below which delays count as one: of rounding, or of no effect.
constexpr double same_delay = 1e-9;

}  // namespace culm::model
