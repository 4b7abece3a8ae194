#include <culm/base/large_vector.hpp>
#include <culm/model/coordinates.hpp>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace culm::model {
namespace {

// Fewer numbers are no matter of pages, and are had faster from the heap.
constexpr std::size_t worth_pages = 131072;

std::size_t bytes(std::size_t numbers) { return numbers * sizeof(double); }

bool all_zero(const double* numbers, std::size_t count) {
  if (count == 0) return true;
  std::uint64_t first = 0;
  std::memcpy(&first, numbers, sizeof first);
  // and each is the one before
  return first == 0 && std::memcmp(numbers, numbers + 1, bytes(count - 1)) == 0;
}

// @param is_fresh  whether the target is zero
void copy_pages(std::span<const double> from, double* to, bool is_fresh) {
  for (std::size_t first = 0; first < from.size(); first += Coordinates::page) {
    const std::size_t count = std::min(Coordinates::page, from.size() - first);
    const bool is_zero = all_zero(from.data() + first, count);
    if (is_zero && (is_fresh || all_zero(to + first, count))) continue;
    std::memcpy(to + first, from.data() + first, bytes(count));
  }
}

}  // namespace

void Coordinates::Free::operator()(double* numbers) const {
  if (room < worth_pages) {
    std::free(numbers);
  } else {
    ::munmap(numbers, bytes(room));
  }
}

Coordinates::Memory Coordinates::make(std::size_t room) {
  if (room == 0) return {};
  if (room < worth_pages) {
    void* const found = std::calloc(room, sizeof(double));
    if (found == nullptr) fail_to_allocate();
    return Memory(static_cast<double*>(found), Free{room});
  }
  void* const found = ::mmap(nullptr, bytes(room), PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (found == MAP_FAILED) fail_to_allocate();
  ::madvise(found, bytes(room), are_all_expected ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
  return Memory(static_cast<double*>(found), Free{room});
}

Coordinates::Coordinates(std::size_t size, double value) { assign(size, value); }

Coordinates::Coordinates(const double* first, const double* last)
    : Coordinates(std::span<const double>(first, last)) {}

Coordinates::Coordinates(std::initializer_list<double> values)
    : Coordinates(std::span<const double>(values.begin(), values.end())) {}

Coordinates::Coordinates(std::span<const double> values) { assign(values); }

Coordinates& Coordinates::assign(std::span<const double> values) {
  if (values.data() == data() && values.size() == size_) return *this;
  const bool fits = size_ == values.size();
  if (!fits) {
    numbers_ = make(values.size());
    size_ = values.size();
  }
  copy_pages(values, data(), !fits);
  return *this;
}

void Coordinates::assign(std::size_t size, double value) {
  if (size == size_) {
    release(0, size);
  } else {
    numbers_ = make(size);
    size_ = size;
  }
  if (value != 0.0) std::fill(begin(), end(), value);
}

void Coordinates::resize(std::size_t size) {
  if (size > numbers_.get_deleter().room) {
    Memory more = make(size);
    copy_pages(*this, more.get(), true);
    numbers_ = std::move(more);
  } else if (size < size_) {
    release(size, size_);
  }
  size_ = size;
}

void Coordinates::append(std::span<const double> values) {
  const std::size_t before = size_;
  if (before + values.size() > numbers_.get_deleter().room) {
    resize(std::max(before + values.size(), 2 * before));
  }
  size_ = before + values.size();
  std::ranges::copy(values, data() + before);
}

void Coordinates::swap(Coordinates& other) noexcept {
  std::swap(numbers_, other.numbers_);
  std::swap(size_, other.size_);
}

void Coordinates::release(std::size_t first, std::size_t last) {
  if (numbers_.get_deleter().room >= worth_pages) {
    static const std::size_t of_system =
        static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) / sizeof(double);
    const std::size_t from = (first + of_system - 1) / of_system * of_system;
    const std::size_t to = last / of_system * of_system;
    // pages that were given back read as zero
    if (from < to && ::madvise(data() + from, bytes(to - from), MADV_DONTNEED) == 0) {
      std::fill(data() + first, data() + from, 0.0);
      first = to;
    }
  }
  std::fill(data() + first, data() + last, 0.0);
}

bool Coordinates::is_zero(std::size_t first, std::size_t last) const {
  return all_zero(data() + first, last - first);
}

}  // namespace culm::model
