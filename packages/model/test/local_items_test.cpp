#include <culm/model/local_items.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace culm::model {
namespace {

LocalItems<std::string> four() {
  LocalItems<std::string> items;
  for (const char* one : {"a", "b", "c", "d"}) items.add(one);
  return items;
}

TEST(LocalItems, AreAllHereAtFirst) {
  const LocalItems<std::string> items = four();
  EXPECT_EQ(items.size(), 4);
  EXPECT_EQ(items.here().size(), 4U);
  EXPECT_EQ(items[3], "d");
  EXPECT_EQ(items.local({1, 3}, 1), "d");
}

TEST(LocalItems, KeepTheirNumbers) {
  LocalItems<std::string> items = four();
  const std::vector<int> mine = {1, 3};
  items.keep(mine);
  items.keep(mine);
  EXPECT_EQ(items.size(), 4);
  EXPECT_EQ(items.here().size(), 2U);
  EXPECT_EQ(items[1], "b");
  EXPECT_EQ(items[3], "d");
  EXPECT_EQ(items.local(mine, 0), "b");
  EXPECT_EQ(items.local(mine, 1), "d");
}

TEST(LocalItems, OfOtherRanksAreABugToAskFor) {
  LocalItems<std::string> items = four();
  items.keep({1, 3});
  EXPECT_FALSE(items.has(2));
  EXPECT_THROW(items[2], InternalError);
  EXPECT_THROW(items[0], InternalError);
  EXPECT_THROW(items.keep({0, 2}), InternalError);
}

TEST(LocalItems, MayAllBeOfOtherRanks) {
  LocalItems<std::string> items = four();
  items.keep({});
  EXPECT_EQ(items.size(), 4);
  EXPECT_THROW(items[1], InternalError);
}

}  // namespace
}  // namespace culm::model
