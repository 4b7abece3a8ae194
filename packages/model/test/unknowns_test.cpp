#include <culm/model/unknowns.hpp>

#include <gtest/gtest.h>

namespace culm::model {
namespace {

NodeTable nodes(int count) {
  NodeTable table;
  for (int i = 0; i < count; ++i) {
    NodeSlots slots;
    slots << Vec3(i, 0.0, 0.0), Mat3::Identity();
    table.add(slots);
  }
  return table;
}

TEST(UnknownTable, NumbersWhatIsSolvedForAndWhatSupportsTakeAway) {
  NodeTable table = nodes(4);
  table.fix(1, std::bitset<6>("000101"));
  table.fix(3, std::bitset<6>("100000"));
  const UnknownTable unknowns(table, {}, {}, Form::null_space);
  ASSERT_EQ(unknowns.num_blocks(), 4);
  EXPECT_EQ(unknowns.num_unknowns(), 21);
  EXPECT_EQ(unknowns.num_reactions(), 3);
  int first = 0;
  for (int b = 0; b < 4; ++b) {
    const Block block = unknowns.block(b);
    EXPECT_EQ(block.owner, b);
    EXPECT_EQ(block.first, first);
    EXPECT_EQ(block.shape.full(), b % 2 == 0);
    first += block.shape.active;
  }
  // each with its own reactions
  EXPECT_EQ(unknowns.block(1).shape.position[0], -1);
  EXPECT_EQ(unknowns.block(1).shape.position[2], -2);
  EXPECT_EQ(unknowns.block(1).shape.first_reaction, 0);
  EXPECT_EQ(unknowns.block(3).shape.position[5], -1);
  EXPECT_EQ(unknowns.block(3).shape.first_reaction, 2);
}

TEST(UnknownTable, NodesThatFollowOthersHaveTheirBlock) {
  NodeTable table = nodes(3);
  ASSERT_TRUE(table.link(2, 0));
  const UnknownTable unknowns(table, {}, {}, Form::null_space);
  EXPECT_EQ(unknowns.node_block(2), 0);
  EXPECT_EQ(unknowns.node_block(1), 1);
  EXPECT_EQ(unknowns.block(2).shape.active, 0);
  EXPECT_EQ(unknowns.num_unknowns(), 12);
  const UnknownTable full(table, {}, {}, Form::multipliers);
  EXPECT_EQ(full.node_block(2), 2);
  EXPECT_EQ(full.num_unknowns(), 36);
}

TEST(UnknownTable, MultipliersAndWhatBatchesOwnComeAfterNodes) {
  OwnBlock own;
  own.first = 5;
  own.unknowns.resize(2);
  own.unknowns[0].kind = UnknownKind::multiplier;
  const UnknownTable unknowns(nodes(2), {3, 1}, {own}, Form::null_space);
  const Block second = unknowns.block(unknowns.constraint_block(1));
  EXPECT_EQ(second.kind, BlockKind::multipliers);
  EXPECT_EQ(second.owner, 1);
  EXPECT_EQ(second.first, 15);
  EXPECT_EQ(second.first_value, 3);
  const Block last = unknowns.block(unknowns.own_block(0));
  EXPECT_EQ(last.kind, BlockKind::own);
  EXPECT_EQ(last.owner, 0);
  EXPECT_EQ(last.first, 16);
  EXPECT_EQ(last.first_value, 5);
  EXPECT_EQ(unknowns.num_forces(), 5);
}

}  // namespace
}  // namespace culm::model
