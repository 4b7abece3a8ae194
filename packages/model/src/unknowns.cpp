#include <culm/model/unknowns.hpp>

#include <algorithm>

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
    : num_nodes_(nodes.size()),
      first_own_(nodes.size() + static_cast<int>(multipliers.size())),
      form_(form) {
  full_shapes_.fill(-1);
  entries_.reserve(static_cast<std::size_t>(num_nodes_) + multipliers.size() + own.size());
  const bool follows = form == Form::null_space && nodes.num_slaves() > 0;
  if (follows) masters_.reserve(static_cast<std::size_t>(num_nodes_));
  for (int node = 0; node < num_nodes_; ++node) {
    if (form == Form::multipliers) {
      add(coordinates_of(nodes.kind(node)), {});
    } else {
      add(6, nodes.is_slave(node) ? std::bitset<6>("111111") : nodes.fixed(node));
    }
    if (follows) masters_.push_back(nodes.master(node));
  }
  for (const int width : multipliers) {
    first_values_.push_back(num_multipliers_);
    num_multipliers_ += width;
    add(width, {});
  }
  for (const OwnBlock& one : own) {
    first_values_.push_back(one.first);
    for (const OwnUnknown& unknown : one.unknowns) {
      num_own_multipliers_ += unknown.kind == UnknownKind::multiplier;
      ++num_own_;
    }
    add(static_cast<int>(one.unknowns.size()), {});
  }
}

void UnknownTable::add(int width, std::bitset<6> fixed) {
  BlockShape shape = shape_without(width, fixed);
  shape.first_reaction = num_reactions_;
  int& shared = full_shapes_[static_cast<std::size_t>(width)];
  const bool is_new = !shape.full() || shared < 0;
  entries_.push_back({is_new ? static_cast<int>(shapes_.size()) : shared, num_unknowns_});
  if (is_new) {
    if (shape.full()) shared = static_cast<int>(shapes_.size());
    shapes_.push_back(shape);
  }
  num_unknowns_ += shape.active;
  num_reactions_ += shape.width - shape.active;
}

int UnknownTable::block_of(int unknown) const {
  // blocks without unknowns share the first of their successor, so the last one before is right
  const auto after = std::ranges::upper_bound(entries_, unknown, {}, &Entry::first);
  return static_cast<int>(after - entries_.begin()) - 1;
}

}  // namespace culm::model
