#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace culm::output {

/// FNV-1a over words of eight bytes, the last one filled up with zeros: tells whether a file is as
/// it was written.
std::uint64_t checksum(std::span<const std::byte> bytes);
/// Goes on with the sum of what came before, whole words.
std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t before);

}  // namespace culm::output
