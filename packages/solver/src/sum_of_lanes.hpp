/// Sums within a pack.
#pragma once

#include <culm/mechanics/pack.hpp>

namespace culm::solver {

/// Of the numbers in all lanes, in pairs.
[[gnu::always_inline]] inline double sum_of_lanes(const Pack& pack) {
  Pack a = pack;
  a += __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3);
  a += __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5);
  a += __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6);
  return a[0];
}

}  // namespace culm::solver
