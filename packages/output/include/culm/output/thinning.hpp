#pragma once

#include <cstddef>

namespace culm::output {

/// Chooses among things that come one after the other, nobody knows how many, at most so many that
/// lie evenly: every one at first, and when there are too many every second, then every fourth of
/// all that came.
class Thinning {
 public:
  /// @param most  at least 2, or 0 for all
  explicit Thinning(std::size_t most) : most_(most) {}

  /// Whether the next one is chosen. This may double the stride: then `keeps` is false for some
  /// that were chosen before.
  bool choose_next() {
    if (most_ > 0 && keeps(count_) && chosen_ == most_) {
      stride_ *= 2;
      chosen_ = (chosen_ + 1) / 2;
    }
    const bool chosen = keeps(count_++);
    if (chosen) ++chosen_;
    return chosen;
  }
  /// Whether one of them is among the chosen, by its number from 0.
  bool keeps(std::size_t number) const { return number % stride_ == 0; }
  /// How many came.
  std::size_t count() const { return count_; }
  std::size_t stride() const { return stride_; }

 private:
  std::size_t most_;
  std::size_t count_ = 0;
  std::size_t chosen_ = 0;
  std::size_t stride_ = 1;
};

}  // namespace culm::output
