#include <culm/parallel/owned_numbers.hpp>

#include <gtest/gtest.h>

namespace culm::parallel {
namespace {

constexpr int count = 7;

// Dealt out like cards.
bool owns(const Comm& comm, int item) { return item % comm.size() == comm.rank(); }

std::vector<double> expected() {
  std::vector<double> all;
  for (int item = 0; item < count; ++item) all.insert(all.end(), {1.0 * item, 0.1 * item});
  return all;
}

void append(int item, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), {1.0 * item, 0.1 * item});
}

TEST(OwnedNumbers, AreGatheredInTheOrderOfTheirItems) {
  const Comm comm;
  const auto all = gather_owned(
      comm, count, 2, [&](int item) { return owns(comm, item); }, append);
  EXPECT_EQ(all, comm.is_root() ? expected() : std::vector<double>());
}

TEST(OwnedNumbers, AreSharedByAllRanks) {
  const Comm comm;
  const auto all = share_owned(
      comm, count, 2, [&](int item) { return owns(comm, item); }, append);
  EXPECT_EQ(all, expected());
}

TEST(OwnedNumbers, AreZeroWhereNobodyOwnsAnItem) {
  const Comm comm;
  const auto all = share_owned(
      comm, count, 2, [&](int item) { return item != 3 && owns(comm, item); }, append);
  std::vector<double> wanted = expected();
  wanted[6] = wanted[7] = 0.0;
  EXPECT_EQ(all, wanted);
}

}  // namespace
}  // namespace culm::parallel
