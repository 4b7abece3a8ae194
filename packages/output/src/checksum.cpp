#include <culm/output/checksum.hpp>

#include <algorithm>
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

}  // namespace culm::output
