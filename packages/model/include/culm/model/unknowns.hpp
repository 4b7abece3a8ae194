/// Blocks of unknowns and their global numbers, independent of the number of ranks.
#pragma once

#include <culm/model/node_table.hpp>
#include <culm/model/own_unknowns.hpp>

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <vector>

namespace culm::model {

/// Which equations a model is solved with.
enum class Form {
  null_space,   ///< six unknowns per node, internal constraints fulfilled by construction
  multipliers,  ///< director coordinates and all constraints as equations: the reference
};

/// The unknowns of one block that are really solved for.
struct BlockShape {
  int width = 0;   ///< unknowns a kernel writes
  int active = 0;  ///< unknowns that are solved for
  /// Place among the active ones; -1 - k for the k-th one that a support takes away.
  std::array<std::int8_t, 12> position{};
  int first_reaction = 0;  ///< of the unknowns taken away, in the array of reactions
  bool full() const { return width == active; }
};

/// Owner of a block.
enum class BlockKind { node, multipliers, own };

/// One run of unknowns that always occur together: those of a node, the multipliers of a
/// constraint, or an OwnBlock.
struct Block {
  BlockKind kind;
  int owner;                ///< number of the node, the constraint or the own block
  const BlockShape& shape;  ///< lives as long as the table
  int first;                ///< global index of the first active unknown
  int first_value;          ///< index into State::multipliers or State::own; not of nodes
};

/// All blocks: nodes first, in node order, then the multipliers of the constraints, then what
/// batches own. Every process knows all of them, so that little is kept of each.
class UnknownTable {
 public:
  UnknownTable() = default;
  /// @param multipliers number of equations of each constraint kept as equations
  UnknownTable(const NodeTable& nodes, const std::vector<int>& multipliers,
               const std::vector<OwnBlock>& own, Form form);
  UnknownTable(UnknownTable&&) = default;
  UnknownTable& operator=(UnknownTable&&) = default;

  int num_blocks() const { return static_cast<int>(entries_.size()); }
  Block block(int b) const {
    const Entry& entry = entries_[static_cast<std::size_t>(b)];
    const BlockShape& shape = shapes_[static_cast<std::size_t>(entry.shape)];
    if (b < num_nodes_) return {BlockKind::node, b, shape, entry.first, 0};
    const int first_value = first_values_[static_cast<std::size_t>(b - num_nodes_)];
    if (b >= first_own_) {
      return {BlockKind::own, b - first_own_, shape, entry.first, first_value};
    }
    return {BlockKind::multipliers, b - num_nodes_, shape, entry.first, first_value};
  }
  /// All of them, one by one.
  auto blocks() const {
    return std::views::iota(0, num_blocks()) |
           std::views::transform([this](int b) { return block(b); });
  }
  /// Number of the block that an unknown belongs to, by its global index.
  int block_of(int unknown) const;
  /// Block that carries the unknowns of a node (that of its master in the null-space form).
  int node_block(int node) const {
    return masters_.empty() ? node : masters_[static_cast<std::size_t>(node)];
  }
  int constraint_block(int constraint) const { return num_nodes_ + constraint; }
  /// Block of an own block, by its number in the model.
  int own_block(int number) const { return first_own_ + number; }
  int num_unknowns() const { return num_unknowns_; }
  int num_multipliers() const { return num_multipliers_; }
  /// Unknowns that are forces of equations: of constraints and of batches.
  int num_forces() const { return num_multipliers_ + num_own_multipliers_; }
  /// Unknowns of batches that are none.
  int num_signals() const { return num_own_ - num_own_multipliers_; }
  /// Unknowns that supports take away; each has a reaction.
  int num_reactions() const { return num_reactions_; }
  Form form() const { return form_; }

 private:
  struct Entry {
    int shape;  // among shapes_
    int first;
  };

  void add(int width, std::bitset<6> fixed);

  std::vector<Entry> entries_;
  // a block without some of its unknowns has its own, as it has its reactions; the others share one
  // for each width
  std::vector<BlockShape> shapes_;
  std::array<int, 13> full_shapes_{};  // the shared ones by width, or -1
  std::vector<int> first_values_;      // of what is no node
  std::vector<int> masters_;           // of all nodes, if any has one
  int num_nodes_ = 0;
  int first_own_ = 0;
  int num_unknowns_ = 0;
  int num_multipliers_ = 0;
  int num_own_ = 0;
  int num_own_multipliers_ = 0;
  int num_reactions_ = 0;
  Form form_ = Form::null_space;
};

}  // namespace culm::model
