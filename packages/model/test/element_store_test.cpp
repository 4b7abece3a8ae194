#include <culm/model/element_store.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace culm::model {
namespace {

// As much of an element as a store needs.
struct Bar {
  static constexpr int num_nodes = 2;
  static constexpr int num_slots = 2;
  int number;
  SlotMatrix<2> mass() const { return number * SlotMatrix<2>::Identity(); }
};

using Nodes = ElementStore<Bar>::Nodes;

// Two series of three and two elements, which note whom they make.
struct Five {
  std::vector<int> made;
  std::vector<int> weighed;
  ElementStore<Bar> store;

  Five() {
    EXPECT_EQ(store.add({{{0, 1}, {1, 2}, {2, 3}}, maker(0)}), 0);
    EXPECT_EQ(store.add({{{4, 5}, {5, 6}},
                         maker(3),
                         [this](const Nodes&, int k) {
                           weighed.push_back(3 + k);
                           return SlotMatrix<2>((3 + k) * SlotMatrix<2>::Identity());
                         }}),
              3);
  }
  std::function<Bar(const Nodes&, int)> maker(int first) {
    return [this, first](const Nodes& nodes, int k) {
      EXPECT_EQ(nodes, store.nodes(first + k));
      made.push_back(first + k);
      return Bar{first + k};
    };
  }
  std::vector<int> visited() const {
    std::vector<int> items;
    store.for_masses([&](const Nodes& nodes, const SlotMatrix<2>& mass) {
      items.push_back(static_cast<int>(mass(0, 0)));
      EXPECT_EQ(nodes, store.nodes(items.back()));
    });
    return items;
  }
};

TEST(ElementStore, MakesThoseThatARankEvaluates) {
  Five five;
  EXPECT_EQ(five.store.size(), 5);
  EXPECT_TRUE(five.made.empty());
  five.store.place({1, 4});
  EXPECT_EQ(five.made, (std::vector{1, 4}));
  EXPECT_EQ(five.store.local(1).element.number, 4);
  EXPECT_EQ(five.store.local(1).nodes, (Nodes{5, 6}));
  EXPECT_EQ(five.store[1].number, 1);
  EXPECT_EQ(five.made.size(), 2U);
}

TEST(ElementStore, MakesOthersOnce) {
  Five five;
  EXPECT_EQ(five.store[3].number, 3);
  five.store.place({0});
  const Bar& other = five.store[2];
  EXPECT_EQ(other.number, 2);
  EXPECT_EQ(&five.store[2], &other);
  EXPECT_EQ(five.made, (std::vector{3, 0, 2}));
  EXPECT_EQ(five.store.make(2).number, 2);
}

TEST(ElementStore, KnowsMassesOfAllUntilOthersAreForgotten) {
  Five five;
  EXPECT_EQ(five.visited(), (std::vector{0, 1, 2, 3, 4}));
  EXPECT_EQ(five.weighed, (std::vector{3, 4}));
  five.store.place({1, 4});
  EXPECT_EQ(five.visited(), (std::vector{0, 1, 2, 3, 4}));
  EXPECT_EQ(five.weighed, (std::vector{3, 4, 3}));
  // modes ask again and again
  EXPECT_EQ(five.visited(), (std::vector{0, 1, 2, 3, 4}));
  EXPECT_EQ(five.weighed.size(), 3U);
  five.store.forget_others();
  EXPECT_EQ(five.visited(), (std::vector{1, 4}));
  EXPECT_EQ(five.store[4].number, 4);
  EXPECT_THROW(five.store[3], InternalError);
}

}  // namespace
}  // namespace culm::model
