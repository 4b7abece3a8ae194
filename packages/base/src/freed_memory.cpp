#include <culm/base/freed_memory.hpp>

#include <malloc.h>

namespace culm {

void set_freed_memory(FreedMemory use) {
  const bool is_kept = use == FreedMemory::kept;
  // larger pieces get pages of their own, which go with them
  mallopt(M_MMAP_THRESHOLD, is_kept ? 32 << 20 : 256 << 10);
  // of what is free at the end of the heap
  mallopt(M_TRIM_THRESHOLD, is_kept ? 64 << 20 : 1 << 20);
}

}  // namespace culm
