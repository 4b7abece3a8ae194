/// Everything about factors of dense blocks that follows from the graph.
#pragma once

#include "block_rows.hpp"

#include <cstddef>
#include <vector>

namespace culm::solver {

/// Where the factors of a matrix stand and how they are computed, block by block.
///
/// Groups of blocks are eliminated one after the other. To group k belongs a panel: its rows
/// [D U], with the square block D of the group and the columns U beside it that are eliminated
/// later, and the rows L below D. Matrices are stored by rows. With A = [D U; L R], what remains is
/// R - L V, V = D^-1 U.
struct BlockPlan {
  struct Panel {
    int size = 0;            ///< unknowns of the group
    int width = 0;           ///< columns of U, rows of L
    int first = 0;           ///< place of its first unknown in the order of elimination
    std::size_t beside = 0;  ///< its part of `beside`
    std::size_t pivot = 0;   ///< [D U] in the values of the factors
    std::size_t below = 0;   ///< L in the values of the factors
    /// Ends of its updates, and of the copies and gaps that are to be done before it is eliminated;
    /// they begin where those of the panel before end.
    std::size_t updates = 0;
    std::size_t copies = 0;
    std::size_t gaps = 0;
    int stride() const { return size + width; }
  };
  /// target -= L V, for some rows of L and some columns of V.
  struct Update {
    std::size_t below = 0;   ///< first row of L
    std::size_t beside = 0;  ///< first column of V
    std::size_t target = 0;
    int stride = 0;  ///< of the target
    int rows = 0;
    int columns = 0;
  };
  /// A rectangle of the matrix that goes to the factors.
  struct Copy {
    std::size_t source = 0;  ///< of the first entry, see BlockRows
    std::size_t target = 0;
    int source_stride = 0;
    int target_stride = 0;
    int rows = 0;
    int columns = 0;
  };

  std::vector<Panel> panels;
  std::vector<int> unknown;  ///< by place in the order of elimination
  std::vector<int> beside;   ///< places of the columns of each U
  std::vector<Update> updates;
  std::vector<Copy> copies;
  /// What the matrix leaves empty in a panel and updates may fill.
  struct Gap {
    std::size_t target = 0;
    std::size_t size = 0;
  };
  std::vector<Gap> gaps;
  std::size_t num_values = 0;
};

/// @param host of each block, see `find_hosts`
/// @param first_kept  the first of the blocks at the end that are not eliminated; if there are any,
/// the D of the last panel is what remains for them
BlockPlan plan_blocks(const BlockRows& rows, const std::vector<int>& host, int first_kept);

}  // namespace culm::solver
