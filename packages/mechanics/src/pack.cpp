#include <culm/math/vector_units.hpp>
#include <culm/mechanics/pack.hpp>

#include <algorithm>
#include <cstring>

namespace culm {
namespace {

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

// Where blocks of pack_lanes numbers start; the last one overlaps the one before where they do not
// come out even.
template <class Visit>
[[gnu::always_inline]] inline void for_blocks(int count, Visit visit) {
  for (int at = 0; at < count; at += pack_lanes) visit(std::min(at, count - pack_lanes));
}

}  // namespace

CULM_FOR_EACH_VECTOR_UNIT void to_lanes(const std::array<const double*, pack_lanes>& rows,
                                        int count, Pack* numbers) {
  for_blocks(
      count, [&](int at) __attribute__((always_inline)) {
        Pack block[pack_lanes];
        for (int l = 0; l < pack_lanes; ++l) {
          std::memcpy(block + l, rows[static_cast<std::size_t>(l)] + at, sizeof(Pack));
        }
        transpose(block);
        for (int c = 0; c < pack_lanes; ++c) numbers[at + c] = block[c];
      });
}

CULM_FOR_EACH_VECTOR_UNIT void from_lanes(const Pack* numbers, int count,
                                          const std::array<double*, pack_lanes>& rows) {
  for_blocks(
      count, [&](int at) __attribute__((always_inline)) {
        Pack block[pack_lanes];
        for (int c = 0; c < pack_lanes; ++c) block[c] = numbers[at + c];
        transpose(block);
        for (int l = 0; l < pack_lanes; ++l) {
          std::memcpy(rows[static_cast<std::size_t>(l)] + at, block + l, sizeof(Pack));
        }
      });
}

}  // namespace culm
