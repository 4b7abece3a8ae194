/// Who owns which unknown, the pattern of the matrix, and the places of all items: found once.
#pragma once

#include <culm/assembly/matrix.hpp>
#include <culm/model/model.hpp>
#include <culm/parallel/comm.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace culm::assembly {

/// Built from a frozen model. Ranks own whole blocks of unknowns, chosen by METIS; an item is
/// evaluated by every rank that owns one of its rows, so matrices are never communicated.
class Layout {
 public:
  /// Builds rows and pattern and gives every batch of the model its placement.
  Layout(model::Model& model, const parallel::Comm& comm);

  /// A block this rank needs: owned or beside an owned one.
  struct LocalBlock {
    int block = 0;
    int first_column = 0;  ///< of its active unknowns, in the column map
    bool owned = false;
  };

  /// Of the unknowns that this rank owns.
  const Rows& rows() const { return *rows_; }
  /// How many of these are of nodes; they come first.
  int num_node_rows() const { return num_node_rows_; }
  /// Of the unknowns that its rows depend on: its own with the same numbers, then others.
  const Rows& columns() const { return *columns_; }
  const Pattern& pattern() const { return *pattern_; }
  const std::vector<LocalBlock>& local_blocks() const { return local_blocks_; }
  /// Owner of each block of the UnknownTable.
  const std::vector<int>& owners() const { return owners_; }
  /// How far the farthest node that follows a node is from it [m]; 0 where none does.
  double lever(int node) const { return levers_.empty() ? 0.0 : levers_[index(node)]; }

 private:
  using Neighbours = std::vector<std::vector<int>>;

  Neighbours couple_blocks(const model::Model& model) const;
  void choose_owners(const model::UnknownTable& unknowns, const Neighbours& neighbours);
  void number_locally(const model::UnknownTable& unknowns, const Neighbours& neighbours);
  std::size_t count_entries(const model::UnknownTable& unknowns,
                            const Neighbours& neighbours) const;
  void build_pattern(const model::UnknownTable& unknowns, const Neighbours& neighbours);
  model::Placement place(const model::Batch& batch, const model::UnknownTable& unknowns) const;
  int offset_in_row(int row_block, int column_block) const;

  parallel::Comm comm_;
  std::vector<int> owners_;
  std::vector<double> levers_;  ///< by node; empty if none follows another
  std::vector<LocalBlock> local_blocks_;
  int num_node_rows_ = 0;
  std::vector<int> local_row_;     ///< first owned row of a block, -1 when not owned
  std::vector<int> local_column_;  ///< first local column of a block, -1 when not here
  /// For owned blocks: the coupled blocks in the order of their columns, and where each run begins;
  /// only while items are placed.
  std::vector<std::vector<std::pair<int, int>>> runs_;
  std::optional<Rows> rows_;
  std::optional<Rows> columns_;
  std::optional<Pattern> pattern_;
};

}  // namespace culm::assembly
