/// Proof that a piece of code allocates nothing: counts every call of malloc in its scope, hence
/// operator new, Eigen's aligned_malloc and the C library alike. For GNU/Linux.
///
/// The functions below replace those of the C library in the test program. They are weak, so that
/// several test files of one program may include this header.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

namespace culm::kit {

/// Allocations of the whole program so far.
inline constinit std::atomic<long> allocation_count{0};

/// Fails the running test if anything is allocated while the guard lives.
///
///     {
///       NoHeap guard;
///       element.gradient(0, q, B);
///     }
class NoHeap {
 public:
  NoHeap() : before_(allocation_count) {}
  NoHeap(const NoHeap&) = delete;
  NoHeap& operator=(const NoHeap&) = delete;
  ~NoHeap() {
    const long found = allocations();
    EXPECT_EQ(found, 0) << "memory was allocated where none may be";
  }
  /// Allocations since the guard was made.
  long allocations() const { return allocation_count - before_; }

 private:
  long before_;
};

}  // namespace culm::kit

extern "C" {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// A sanitizer has its own malloc and reports each call here.
__attribute__((weak)) void __sanitizer_malloc_hook(const volatile void*, std::size_t) {
  ++culm::kit::allocation_count;
}
#else
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

__attribute__((weak)) void* malloc(std::size_t size) noexcept {
  ++culm::kit::allocation_count;
  return __libc_malloc(size);
}
__attribute__((weak)) void* calloc(std::size_t count, std::size_t size) noexcept {
  ++culm::kit::allocation_count;
  return __libc_calloc(count, size);
}
__attribute__((weak)) void* realloc(void* old, std::size_t size) noexcept {
  ++culm::kit::allocation_count;
  return __libc_realloc(old, size);
}
__attribute__((weak)) void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++culm::kit::allocation_count;
  return __libc_memalign(alignment, size);
}
#endif
}
