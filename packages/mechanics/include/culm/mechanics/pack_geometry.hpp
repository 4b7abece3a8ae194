/// Vectors and triads of packs, for functions that are compiled for each vector unit.
#pragma once

#include <culm/mechanics/pack.hpp>

/// Before functions of packs: what is not inlined stays compiled for the least processor.
#define CULM_INLINE [[gnu::always_inline]] inline

namespace culm {

/// sum += factor a x b
CULM_INLINE void add_cross(const Pack* a, const Pack* b, const Pack& factor, Pack* sum) {
  sum[0] += factor * (a[1] * b[2] - a[2] * b[1]);
  sum[1] += factor * (a[2] * b[0] - a[0] * b[2]);
  sum[2] += factor * (a[0] * b[1] - a[1] * b[0]);
}

/// block += sign [a], in rows of this length
CULM_INLINE void add_skew(const Pack* a, double sign, Pack* block, int row) {
  block[1] -= sign * a[2];
  block[2] += sign * a[1];
  block[row] += sign * a[2];
  block[row + 2] -= sign * a[0];
  block[2 * row] -= sign * a[1];
  block[2 * row + 1] += sign * a[0];
}

/// What model::add_triad_tangent adds to the tangent of N triads, where no node is at a lever: see
/// there. @param A  scalars between slots, shape (4 N, 4 N) @param force  on slots, shape (12 N)
template <int N>
CULM_INLINE void add_pack_geometry(const Pack* A, const Pack* force, const Pack* mid,
                                   const Pack* next, double theta, Pack* K) {
  constexpr int S = 4 * N;
  constexpr int row = 6 * N;
  for (int b = 0; b < N; ++b) {
    const Pack* arms = next + 12 * b;
    for (int a = 0; a < N; ++a) {
      const Pack* own = mid + 12 * a;
      Pack v[12], W[9] = {}, lever[3] = {};
      for (int s = 0; s < 4; ++s) {
        const Pack* of_slot = A + S * (4 * a + s) + 4 * b;
        for (int c = 0; c < 3; ++c) {
          v[3 * s + c] =
              of_slot[1] * arms[3 + c] + of_slot[2] * arms[6 + c] + of_slot[3] * arms[9 + c];
        }
      }
      for (int s = 1; s < 4; ++s) {
        const Pack& by_position = A[S * (4 * a + s) + 4 * b];
        for (int c = 0; c < 3; ++c) {
          lever[c] += by_position * own[3 * s + c];
          for (int d = 0; d < 3; ++d) {
            W[3 * c + d] += v[3 * s + c] * own[3 * s + d];
            if (a == b) W[3 * c + d] -= theta * arms[3 * s + c] * force[12 * a + 3 * s + d];
          }
        }
      }
      Pack* block = K + 6 * row * a + 6 * b;
      const Pack trace = W[0] + W[4] + W[8];
      for (int c = 0; c < 3; ++c) {
        block[row * c + c] += A[S * 4 * a + 4 * b];
        block[row * (3 + c) + 3 + c] += trace;
        for (int d = 0; d < 3; ++d) block[row * (3 + c) + 3 + d] -= W[3 * c + d];
      }
      add_skew(v, -1.0, block + 3, row);
      add_skew(lever, 1.0, block + 3 * row, row);
    }
  }
}

}  // namespace culm
