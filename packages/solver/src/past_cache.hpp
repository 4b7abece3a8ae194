/// Numbers that go to memory past the caches.
#pragma once

#include <algorithm>
#include <cstddef>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace culm::solver {

/// Copies an even count of numbers that will not be read soon. Ordinary stores would first read
/// each line from memory. @param to  aligned to 16 bytes
[[gnu::always_inline]] inline void copy_past_cache(const double* from, int count, double* to) {
#if defined(__SSE2__)
#pragma GCC unroll 6
  for (int k = 0; k < count; k += 2) _mm_stream_pd(to + k, _mm_loadu_pd(from + k));
#else
  std::copy_n(from, count, to);
#endif
}

}  // namespace culm::solver
