/// Who owns which unknown, the matrix graph, and the places of all items: found once.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/model/model.hpp>
#include <culm/parallel/comm.hpp>

namespace culm::assembly {

/// Built from a frozen model. Ranks own whole blocks of unknowns, chosen by METIS; an item is
/// evaluated by every rank that owns one of its rows, so matrices are never communicated.
class Layout {
 public:
  /// Builds maps and graph and gives every batch of the model its placement.
  Layout(model::Model& model, const parallel::Comm& comm);

  /// A block this rank needs: owned or beside an owned one.
  struct LocalBlock {
    int block = 0;
    int first_column = 0;  ///< of its active unknowns, in the column map
    bool owned = false;
  };

  const Teuchos::RCP<const Map>& row_map() const { return row_map_; }
  const Teuchos::RCP<const Map>& column_map() const { return column_map_; }
  const Teuchos::RCP<const CrsGraph>& graph() const { return graph_; }
  const std::vector<LocalBlock>& local_blocks() const { return local_blocks_; }
  /// Owner of each block of the UnknownTable.
  const std::vector<int>& owners() const { return owners_; }

 private:
  using Neighbours = std::vector<std::vector<int>>;

  Neighbours couple_blocks(const model::Model& model) const;
  void choose_owners(const model::UnknownTable& unknowns, const Neighbours& neighbours);
  void number_locally(const model::UnknownTable& unknowns, const Neighbours& neighbours);
  void build_graph(const model::UnknownTable& unknowns, const Neighbours& neighbours);
  model::Placement place(const model::Batch& batch, const model::UnknownTable& unknowns) const;
  int offset_in_row(int row_block, int column_block) const;

  parallel::Comm comm_;
  std::vector<int> owners_;
  std::vector<LocalBlock> local_blocks_;
  std::vector<int> local_row_;     ///< first owned row of a block, -1 when not owned
  std::vector<int> local_column_;  ///< first local column of a block, -1 when not here
  /// For owned blocks: the coupled blocks in the order of their columns, and where each run begins.
  std::vector<std::vector<std::pair<int, int>>> runs_;
  Teuchos::RCP<const Map> row_map_;
  Teuchos::RCP<const Map> column_map_;
  Teuchos::RCP<const CrsGraph> graph_;
};

}  // namespace culm::assembly
