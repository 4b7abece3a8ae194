#include <culm/model/coordinates.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace culm::model {
namespace {

constexpr std::size_t large = 12'800'000;  // 102 MB

// Pages that were written to: some kernels count the one page of zeros as resident wherever it is
// read.
double resident_megabytes() {
  std::ifstream file("/proc/self/smaps_rollup");
  for (std::string word; file >> word;) {
    double kilobytes = 0.0;
    if (word == "Private_Dirty:" && file >> kilobytes) return kilobytes / 1e3;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(Coordinates, AreZeroAtFirstAndKeepWhatIsWritten) {
  for (const std::size_t size : {std::size_t{24}, large}) {
    Coordinates q(size);
    EXPECT_EQ(q.size(), size);
    EXPECT_EQ(q[size - 1], 0.0);
    q[size - 2] = 3.0;
    const Coordinates copy = q;
    Coordinates assigned(size, 7.0);
    assigned = copy;
    EXPECT_TRUE(std::ranges::equal(q, copy));
    EXPECT_TRUE(std::ranges::equal(q, assigned));
  }
}

TEST(Coordinates, TakeMemoryForWhatIsWrittenOnly) {
  const double before = resident_megabytes();
  Coordinates q(large);
  q[5'000'000] = 1.0;
  const Coordinates copy = q;
  Coordinates assigned(large);
  assigned = copy;
  Coordinates sum(large);
  combine(
      sum, [](double, double a, double b) { return a + b; }, q, assigned);
  EXPECT_EQ(sum[5'000'000], 2.0);
  EXPECT_LT(resident_megabytes() - before, 10.0);
}

TEST(Coordinates, GiveBackWhatIsReleased) {
  const double before = resident_megabytes();
  Coordinates q(large, 1.0);
  EXPECT_GT(resident_megabytes() - before, 90.0);
  q.release(100, large - 100);
  EXPECT_LT(resident_megabytes() - before, 10.0);
  EXPECT_EQ(q[99], 1.0);
  EXPECT_TRUE(q.is_zero(100, large - 100));
  EXPECT_EQ(q[large - 100], 1.0);
}

TEST(Coordinates, GrowWithZerosAndByWhatIsAppended) {
  Coordinates q{1.0, 2.0, 3.0};
  q.resize(2);
  q.resize(4);
  EXPECT_TRUE(std::ranges::equal(q, std::vector{1.0, 2.0, 0.0, 0.0}));
  const std::vector<double> more(1000, 5.0);
  for (int i = 0; i < 300; ++i) q.append(more);
  ASSERT_EQ(q.size(), 300'004U);
  EXPECT_EQ(q[1], 2.0);
  EXPECT_TRUE(std::all_of(q.begin() + 4, q.end(), [](double x) { return x == 5.0; }));
}

TEST(Coordinates, CopiesKeepTheSignOfZero) {
  const Coordinates q{-0.0, 0.0};
  const Coordinates copy = q;
  EXPECT_TRUE(std::signbit(copy[0]));
  EXPECT_FALSE(std::signbit(copy[1]));
}

}  // namespace
}  // namespace culm::model
