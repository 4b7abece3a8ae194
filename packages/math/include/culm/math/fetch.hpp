/// What is needed soon, asked for in time. Functions that do nothing but ask have to be inlined
/// (`gnu::always_inline`): compilers take them for such without effect and leave their calls out.
#pragma once

#include <cstddef>

namespace culm {

/// So many numbers ahead of what is read in order memory is worth being asked: processors do so by
/// themselves, but only up to the end of a page.
inline constexpr std::size_t numbers_ahead = 1024;

/// Asks the memory for bytes that will be read. They need not exist.
[[gnu::always_inline]] inline void fetch(const void* from, std::size_t bytes) {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < bytes; at += line) {
    __builtin_prefetch(static_cast<const char*>(from) + at);
  }
}

/// The same of bytes that will be written.
[[gnu::always_inline]] inline void fetch_to_write(const void* to, std::size_t bytes) {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < bytes; at += line) {
    __builtin_prefetch(static_cast<const char*>(to) + at, 1);
  }
}

}  // namespace culm
