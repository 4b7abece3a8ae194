/// Arrays that are read and written from one end to the other, time and again.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace culm {

/// Bytes from which on large pages are taken.
constexpr std::size_t worth_large_pages = std::size_t{4} << 20;

/// Does as operator new where there is no memory: calls the handler that is set for that, and
/// throws std::bad_alloc.
[[noreturn]] void fail_to_allocate();

/// Room for so many bytes, on large pages of memory (two megabytes) where the system has them: a
/// processor fetches ahead within a page only, and looks up where each page is. Where the system
/// has none the pages are small. @throws std::bad_alloc
void* allocate_pages(std::size_t bytes);
void free_pages(void* memory, std::size_t bytes) noexcept;
/// The same for memory that others have allocated and nobody has written to, if it is worth it.
void prefer_large_pages(void* memory, std::size_t bytes) noexcept;

/// Takes large pages for what fills several of them, and the heap for the rest.
template <class T>
struct PageAllocator {
  using value_type = T;

  PageAllocator() = default;
  template <class U>
  PageAllocator(const PageAllocator<U>&) {}  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes >= worth_large_pages) return static_cast<T*>(allocate_pages(bytes));
    return static_cast<T*>(::operator new(bytes, std::align_val_t(alignof(T))));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    const std::size_t bytes = count * sizeof(T);
    if (bytes >= worth_large_pages) return free_pages(memory, bytes);
    ::operator delete(memory, std::align_val_t(alignof(T)));
  }
  friend bool operator==(const PageAllocator&, const PageAllocator&) { return true; }
};

template <class T>
using LargeVector = std::vector<T, PageAllocator<T>>;

}  // namespace culm
