#include <culm/model/coordinates.hpp>

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <vector>

namespace culm::model {
namespace {

constexpr std::size_t large = 12'800'000;  // 102 MB

double resident_megabytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

// Whether pages that were only read take memory: most systems show one page of zeros for all.
bool reading_takes_memory() {
  const double before = resident_megabytes();
  const Coordinates q(large);
  const double sum = std::accumulate(q.begin(), q.end(), 0.0);
  EXPECT_EQ(sum, 0.0);
  return resident_megabytes() - before > 10.0;
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
  if (reading_takes_memory()) GTEST_SKIP() << "here memory is taken by what is read";
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
  for (const bool all : {true, false}) {
    Coordinates::expect_all(all);
    const double before = resident_megabytes();
    Coordinates q(large, 1.0);
    EXPECT_GT(resident_megabytes() - before, 90.0);
    q.release(100, large - 100);
    EXPECT_LT(resident_megabytes() - before, 10.0);
    EXPECT_EQ(q[99], 1.0);
    EXPECT_TRUE(q.is_zero(100, large - 100));
    EXPECT_EQ(q[large - 100], 1.0);
  }
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
