#include <culm/base/large_vector.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <utility>

namespace culm {
namespace {

constexpr std::size_t several_pages = 3 << 20;  // numbers

std::size_t mapped_pages() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages;
}

TEST(LargeVector, KeepsItsNumbersWhileItGrows) {
  LargeVector<double> numbers;
  for (std::size_t i = 0; i < several_pages; ++i) numbers.push_back(static_cast<double>(i));
  for (std::size_t i = 0; i < several_pages; ++i) ASSERT_EQ(numbers[i], static_cast<double>(i));
  const LargeVector<double> copy = numbers;
  const LargeVector<double> moved = std::move(numbers);
  EXPECT_EQ(copy, moved);
}

TEST(LargeVector, BeginsWhereALargePageDoes) {
  LargeVector<double> large(several_pages, 1.0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(large.data()) % (2 << 20), 0u);
  struct alignas(64) Line {
    double numbers[8];
  };
  LargeVector<Line> small(3);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(small.data()) % 64, 0u);
}

TEST(LargeVector, GivesItsMemoryBack) {
  const std::size_t before = mapped_pages();
  for (int i = 0; i < 20; ++i)
    LargeVector<double>(several_pages + static_cast<std::size_t>(i), 1.0);
  EXPECT_LT(mapped_pages(), before + several_pages * sizeof(double) / 4096);
}

TEST(LargeVector, MemoryOfOthersMayBeOfAnySize) {
  std::vector<double> mine(several_pages, 2.0);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, several_pages}) {
    prefer_large_pages(mine.data(), count * sizeof(double));
  }
  EXPECT_EQ(mine, std::vector<double>(several_pages, 2.0));
}

}  // namespace
}  // namespace culm
