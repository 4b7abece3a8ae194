#pragma once

#include <culm/base/row_ranges.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace culm::output {

/// FNV-1a over words of eight bytes, the last one filled up with zeros: tells whether a file is as
/// it was written.
std::uint64_t checksum(std::span<const std::byte> bytes);
/// Goes on with the sum of what came before, whole words.
std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t before);

/// The mixing function of splitmix64 (Steele, Lea, Flood 2014), a bijection: terms of a sum must
/// not resemble each other.
inline std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// The same for numbers that come in pieces, from many processes: sums of the pieces add up to that
/// of the whole, in any order.
/// @param first  how many numbers of the whole are before these
std::uint64_t sum_of_numbers(std::span<const double> numbers, std::uint64_t first = 0);
/// That of rows of a table.
/// @param numbers  row after row
/// @param before   how many numbers of the whole are before the table
std::uint64_t sum_of_rows(std::span<const RowRange> rows, std::size_t width,
                          std::span<const double> numbers, std::uint64_t before = 0);

}  // namespace culm::output
