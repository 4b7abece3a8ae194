#include "base64.hpp"

#include <algorithm>
#include <cstdint>

namespace culm::output {

std::string base64(std::span<const std::byte> bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3, out += 4) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    }
    // n bytes fill n + 1 digits; the rest of four is padding.
    for (std::size_t k = 0; k <= count; ++k) out[k] = digits[group >> (18 - 6 * k) & 63U];
  }
  return text;
}

}  // namespace culm::output
