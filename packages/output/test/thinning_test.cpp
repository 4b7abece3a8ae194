#include <culm/output/thinning.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace culm::output {
namespace {

TEST(Thinning, KeepsAtMostSoManyThatLieEvenlyFromTheFirst) {
  for (const std::size_t most : {2U, 3U, 4U, 7U}) {
    Thinning thinning(most);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < 100; ++i) {
      const bool chosen = thinning.choose_next();
      std::erase_if(kept, [&](std::size_t number) { return !thinning.keeps(number); });
      if (chosen) kept.push_back(i);
      EXPECT_EQ(thinning.count(), i + 1);
      EXPECT_LE(kept.size(), most);
      EXPECT_EQ(kept.front(), 0);
      for (std::size_t k = 0; k < kept.size(); ++k) EXPECT_EQ(kept[k], k * thinning.stride());
      // the next one would be beyond i
      EXPECT_GT(kept.size() * thinning.stride(), i);
    }
  }
}

TEST(Thinning, KeepsAllWithoutALimit) {
  Thinning thinning(0);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(thinning.choose_next());
  EXPECT_EQ(thinning.stride(), 1);
}

}  // namespace
}  // namespace culm::output
