#include <culm/mechanics/pack.hpp>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace culm {
namespace {

// Number c of lane l.
double number(std::size_t l, std::size_t c) {
  return 1000.0 * static_cast<double>(l) + static_cast<double>(c);
}

// Counts that are multiples of the lanes, and others.
class Lanes : public testing::TestWithParam<int> {
 protected:
  std::size_t count = static_cast<std::size_t>(GetParam());
  std::vector<Packs<1>> store = std::vector<Packs<1>>(count + 1);  // one more than count
  Pack* numbers = store[0].data();
  std::array<std::vector<double>, pack_lanes> rows;
};

TEST_P(Lanes, HoldTheNumbersOfTheirRows) {
  std::array<const double*, pack_lanes> begins;
  for (std::size_t l = 0; l < pack_lanes; ++l) {
    for (std::size_t c = 0; c < count; ++c) rows[l].push_back(number(l, c));
    begins[l] = rows[l].data();
  }
  numbers[count] = Pack{} + 0.5;
  to_lanes(begins, GetParam(), numbers);
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t l = 0; l < pack_lanes; ++l) EXPECT_EQ(numbers[c][l], number(l, c));
  }
  for (std::size_t l = 0; l < pack_lanes; ++l) EXPECT_EQ(numbers[count][l], 0.5);
}

TEST_P(Lanes, GoBackToTheirRowsAndNoFurther) {
  std::array<double*, pack_lanes> begins;
  for (std::size_t l = 0; l < pack_lanes; ++l) {
    rows[l].assign(count + 1, 0.5);
    begins[l] = rows[l].data();
    for (std::size_t c = 0; c < count; ++c) numbers[c][l] = number(l, c);
  }
  from_lanes(numbers, GetParam(), begins);
  for (std::size_t l = 0; l < pack_lanes; ++l) {
    for (std::size_t c = 0; c < count; ++c) EXPECT_EQ(rows[l][c], number(l, c));
    EXPECT_EQ(rows[l][count], 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, Lanes, testing::Values(8, 12, 18, 24, 36, 144, 577));

}  // namespace
}  // namespace culm
