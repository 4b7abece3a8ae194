/// Motion that a support imposes.
#pragma once

#include <culm/model/amplitude.hpp>

namespace culm::joint {

/// An angle [rad] or a distance [m] as a function of time.
struct Prescribed {
  double amount = 0.0;  ///< at function value 1
  model::Amplitude function = model::Amplitude::constant();

  /// Whether anything moves; a support that stands still may be eliminated.
  bool moves() const { return amount != 0.0; }
  double at(double time) const { return amount * function.at(time); }
};

}  // namespace culm::joint
