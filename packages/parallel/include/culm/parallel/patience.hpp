/// Waiting for what another process does.
#pragma once

#include <chrono>

namespace culm::parallel {

/// Between looks at what another process does: looks follow each other at first, and later not so
/// often that the other one would miss the processor.
class Patience {
 public:
  /// Since it was made [s].
  double waited() const;
  /// Whether looks no longer follow each other at once.
  bool is_long() const;
  /// Until the next look.
  void pause() const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace culm::parallel
