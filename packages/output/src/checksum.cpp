#include <culm/output/checksum.hpp>

#include <algorithm>
#include <bit>
#include <cstring>

namespace culm::output {

std::uint64_t checksum(std::span<const std::byte> bytes) {
  return checksum(bytes, 0xcbf29ce484222325);
}

std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t before) {
  std::uint64_t sum = before;
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = std::min(bytes.size(), sizeof word);
    std::memcpy(&word, bytes.data(), count);
    sum = (sum ^ word) * 0x100000001b3;
    bytes = bytes.subspan(count);
  }
  return sum;
}

std::uint64_t sum_of_numbers(std::span<const double> numbers, std::uint64_t first) {
  std::uint64_t sum = 0;
  for (const double number : numbers) {
    // a number and its place; the factor is that of splitmix64
    sum += mix(std::bit_cast<std::uint64_t>(number) + ++first * 0x9e3779b97f4a7c15);
  }
  return sum;
}

std::uint64_t sum_of_rows(std::span<const RowRange> rows, std::size_t width,
                          std::span<const double> numbers, std::uint64_t before) {
  std::uint64_t sum = 0;
  for (const RowRange& range : rows) {
    const std::size_t count = range.count * width;
    sum += sum_of_numbers(numbers.first(count), before + range.first * width);
    numbers = numbers.subspan(count);
  }
  return sum;
}

}  // namespace culm::output
