/// Unknowns that batches own, beside the motions of nodes and the multipliers of constraints.
#pragma once

#include <culm/model/state.hpp>

#include <string>
#include <vector>

namespace culm::model {

/// How an unknown enters its own equation.
enum class UnknownKind {
  multiplier,   ///< force of an equation that the batch adds: one value per step
  algebraic,    ///< follows from others at once: one value per step, that of its middle
  first_order,  ///< has a rate: values at both ends of the step; stands still in statics
};

/// One unknown. Its row adds up to zero in units of `scale`, and the same holds for its column, but
/// for a multiplier, which is scaled as those of constraints.
struct OwnUnknown {
  std::string name;
  UnknownKind kind = UnknownKind::algebraic;
  double scale = 1.0;    ///< its size where it is small
  double initial = 0.0;  ///< value at the start
};

/// Unknowns that always occur together, up to twelve.
struct OwnBlock {
  std::string name;  ///< for messages
  std::vector<OwnUnknown> unknowns;
  int first = 0;  ///< index into State::own; given by the model
};

/// An unknown that loads, constraints and other batches follow.
struct Signal {
  int block = -1;  ///< number among the own blocks of the model
  int place = 0;   ///< in the block
  int index = -1;  ///< into State::own
  UnknownKind kind = UnknownKind::algebraic;
  double scale = 1.0;

  /// The value that acts at (1 - theta) prev + theta next of a step.
  double in_step(const State& state, double theta) const {
    const auto at = static_cast<std::size_t>(index);
    if (kind != UnknownKind::first_order) return state.own[at];
    return (1.0 - theta) * state.own_prev[at] + theta * state.own[at];
  }
  /// Its derivative by the scaled unknown.
  double weight(double theta) const {
    return scale * (kind == UnknownKind::first_order ? theta : 1.0);
  }
};

}  // namespace culm::model
