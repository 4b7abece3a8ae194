#include <culm/model/unknowns.hpp>

namespace culm::model {
namespace {

BlockShape shape_without(int width, std::bitset<6> fixed) {
  BlockShape shape;
  shape.width = width;
  int gone = 0;
  for (int i = 0; i < width; ++i) {
    const bool is_fixed = i < 6 && fixed[static_cast<std::size_t>(i)];
    shape.position[static_cast<std::size_t>(i)] =
        static_cast<std::int8_t>(is_fixed ? -1 - gone++ : shape.active++);
  }
  return shape;
}

}  // namespace

UnknownTable::UnknownTable(const NodeTable& nodes, const std::vector<int>& multipliers,
                           const std::vector<OwnBlock>& own, Form form)
    : first_constraint_(nodes.size()),
      first_own_(nodes.size() + static_cast<int>(multipliers.size())),
      form_(form) {
  for (int node = 0; node < nodes.size(); ++node) {
    Block block;
    block.owner = node;
    if (form == Form::multipliers) {
      block.shape = shape_without(coordinates_of(nodes.kind(node)), {});
    } else {
      const auto fixed = nodes.is_slave(node) ? std::bitset<6>("111111") : nodes.fixed(node);
      block.shape = shape_without(6, fixed);
    }
    node_block_.push_back(form == Form::multipliers ? node : nodes.master(node));
    blocks_.push_back(block);
  }
  for (int c = 0; c < static_cast<int>(multipliers.size()); ++c) {
    Block block;
    block.kind = BlockKind::multipliers;
    block.owner = c;
    block.shape = shape_without(multipliers[static_cast<std::size_t>(c)], {});
    block.first_value = num_multipliers_;
    num_multipliers_ += block.shape.width;
    blocks_.push_back(block);
  }
  for (int b = 0; b < static_cast<int>(own.size()); ++b) {
    const OwnBlock& one = own[static_cast<std::size_t>(b)];
    Block block;
    block.kind = BlockKind::own;
    block.owner = b;
    block.shape = shape_without(static_cast<int>(one.unknowns.size()), {});
    block.first_value = one.first;
    for (const OwnUnknown& unknown : one.unknowns) {
      num_own_multipliers_ += unknown.kind == UnknownKind::multiplier;
      ++num_own_;
    }
    blocks_.push_back(block);
  }
  for (Block& block : blocks_) {
    block.first = num_unknowns_;
    num_unknowns_ += block.shape.active;
    block.shape.first_reaction = num_reactions_;
    num_reactions_ += block.shape.width - block.shape.active;
  }
}

}  // namespace culm::model
