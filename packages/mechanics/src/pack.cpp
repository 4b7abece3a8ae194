#include <culm/math/vector_units.hpp>
#include <culm/mechanics/pack.hpp>

#include <algorithm>
#include <cstring>

namespace culm {
namespace {

constexpr int half = pack_lanes / 2;
using HalfPack = double __attribute__((vector_size(half * sizeof(double))));

// Rows of a block to columns: neighbours are exchanged, then pairs, then halves.
[[gnu::always_inline]] inline void transpose(Pack* a) {
  Pack b[pack_lanes];
  for (int i = 0; i < pack_lanes; i += 2) {
    b[i] = __builtin_shufflevector(a[i], a[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    b[i + 1] = __builtin_shufflevector(a[i], a[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i : {0, 1, 4, 5}) {
    a[i] = __builtin_shufflevector(b[i], b[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    a[i + 2] = __builtin_shufflevector(b[i], b[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int i = 0; i < 4; ++i) {
    b[i] = __builtin_shufflevector(a[i], a[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    b[i + 4] = __builtin_shufflevector(a[i], a[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
  for (int i = 0; i < pack_lanes; ++i) a[i] = b[i];
}

// The same of half a block: rows i and i + 4 stand side by side in a[i], columns come out whole;
// and the way back.
[[gnu::always_inline]] inline void transpose_half(Pack* a) {
  Pack b[half];
  for (int i = 0; i < half; i += 2) {
    b[i] = __builtin_shufflevector(a[i], a[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    b[i + 1] = __builtin_shufflevector(a[i], a[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 2; ++i) {
    a[i] = __builtin_shufflevector(b[i], b[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    a[i + 2] = __builtin_shufflevector(b[i], b[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
}

}  // namespace

// Half blocks take fewer exchanges, as rows are put side by side where they are read.
CULM_FOR_EACH_VECTOR_UNIT void to_lanes(const std::array<const double*, pack_lanes>& rows,
                                        int count, Pack* numbers) {
  for (int next = 0; next < count; next += half) {
    const int at = std::min(next, count - half);
    Pack block[half];
    for (std::size_t i = 0; i < half; ++i) {
      HalfPack low, high;
      std::memcpy(&low, rows[i] + at, sizeof(HalfPack));
      std::memcpy(&high, rows[i + half] + at, sizeof(HalfPack));
      block[i] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    }
    transpose_half(block);
    for (int c = 0; c < half; ++c) numbers[at + c] = block[c];
  }
}

// Here whole blocks take fewer stores.
CULM_FOR_EACH_VECTOR_UNIT void from_lanes(const Pack* numbers, int count,
                                          const std::array<double*, pack_lanes>& rows) {
  int next = 0;
  for (; next + pack_lanes <= count; next += pack_lanes) {
    Pack block[pack_lanes];
    for (int c = 0; c < pack_lanes; ++c) block[c] = numbers[next + c];
    transpose(block);
    for (std::size_t l = 0; l < pack_lanes; ++l) {
      std::memcpy(rows[l] + next, block + l, sizeof(Pack));
    }
  }
  for (; next < count; next += half) {
    const int at = std::min(next, count - half);
    Pack block[half];
    for (int c = 0; c < half; ++c) block[c] = numbers[at + c];
    transpose_half(block);
    for (std::size_t i = 0; i < half; ++i) {
      const HalfPack low = __builtin_shufflevector(block[i], block[i], 0, 1, 2, 3);
      const HalfPack high = __builtin_shufflevector(block[i], block[i], 4, 5, 6, 7);
      std::memcpy(rows[i] + at, &low, sizeof(HalfPack));
      std::memcpy(rows[i + half] + at, &high, sizeof(HalfPack));
    }
  }
}

}  // namespace culm
