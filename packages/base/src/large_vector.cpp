#include <culm/base/large_vector.hpp>

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace culm {
namespace {

constexpr std::uintptr_t large_page = std::uintptr_t{2} << 20;

std::uintptr_t page() { return static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE)); }

std::uintptr_t down(std::uintptr_t address, std::uintptr_t size) { return address / size * size; }
std::uintptr_t up(std::uintptr_t address, std::uintptr_t size) {
  return down(address + size - 1, size);
}

void give_back(std::uintptr_t from, std::uintptr_t to) {
  if (to > from) ::munmap(reinterpret_cast<void*>(from), to - from);
}

}  // namespace

void fail_to_allocate() {
  if (const std::new_handler handler = std::get_new_handler()) handler();
  throw std::bad_alloc();
}

// Systems of before Linux 6.7 do not place maps where large pages begin.
void* allocate_pages(std::size_t bytes) {
  void* const found = ::mmap(nullptr, bytes + large_page, PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (found == MAP_FAILED) fail_to_allocate();
  const auto first = reinterpret_cast<std::uintptr_t>(found);
  const std::uintptr_t begin = up(first, large_page);
  give_back(first, begin);
  give_back(up(begin + bytes, page()), up(first + bytes + large_page, page()));
  void* const memory = reinterpret_cast<void*>(begin);
  prefer_large_pages(memory, bytes);
  return memory;
}

void free_pages(void* memory, std::size_t bytes) noexcept { ::munmap(memory, bytes); }

// To be told that there are none changes nothing.
void prefer_large_pages(void* memory, std::size_t bytes) noexcept {
  if (bytes < worth_large_pages) return;
  const auto first = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = up(first, page()), end = down(first + bytes, page());
  if (end > begin) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace culm
