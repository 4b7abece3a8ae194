/// Everything about factors of dense blocks that follows from the graph.
#pragma once

#include "block_rows.hpp"

#include <cstddef>
#include <vector>

namespace culm::solver {

/// So many numbers, rounded up to whole lines of the cache, of which no two panels share one.
constexpr std::size_t whole_lines(std::size_t count) {
  constexpr std::size_t line = 8;
  return (count + line - 1) / line * line;
}

/// Where the factors of a matrix stand and how they are computed, block by block.
///
/// Groups of blocks are eliminated one after the other. To group k belongs a panel: its rows
/// [D U], with the square block D of the group and the columns U beside it that are eliminated
/// later, and the rows L below D. Matrices are stored by rows. With A = [D U; L R], what remains is
/// R - L V, V = D^-1 U.
///
/// Where the cache holds all of them, panels stay where they are made. Others are made on a bench,
/// from when something is first subtracted from them until they are eliminated; then their place
/// on it is free for the next. So a bench of few numbers stays in the cache, and what is finished
/// is written once, past the cache, and not read before a solution wants it.
struct BlockPlan {
  struct Panel {
    int size = 0;            ///< unknowns of the group
    int width = 0;           ///< columns of U, rows of L
    int first = 0;           ///< place of its first unknown in the order of elimination
    std::size_t beside = 0;  ///< its part of `beside`
    std::size_t pivot = 0;   ///< [D U] where it is made
    std::size_t below = 0;   ///< L where it is made
    /// D, V and L where they stay; V and the others are counted each for themselves where they come
    /// from a bench.
    std::size_t D = 0;
    std::size_t V = 0;
    std::size_t L = 0;
    /// Ends of its updates, and of the copies and gaps that are to be done before it is eliminated;
    /// they begin where those of the panel before end.
    std::size_t updates = 0;
    std::size_t copies = 0;
    std::size_t gaps = 0;
    int stride() const { return size + width; }
  };
  /// target -= L V, for some rows of L and some columns of V, where panels are made.
  struct Update {
    std::size_t below = 0;   ///< first row of L
    std::size_t beside = 0;  ///< first column of V
    std::size_t target = 0;
    int stride = 0;  ///< of the target
    int rows = 0;
    int columns = 0;
  };
  /// A rectangle of the matrix that goes to where a panel is made.
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
  std::size_t bench_size = 0;  ///< 0 without a bench
  /// Of the factors; of those that come from a bench V alone, that of the panel eliminated last in
  /// front, as solutions read them.
  std::size_t num_values = 0;
  std::size_t num_lower = 0;  ///< D and L that come from a bench
};

/// More numbers come from memory, and not from a cache.
constexpr std::size_t cached_values = std::size_t{1} << 20;

/// @param host of each block, see `find_hosts`
/// @param first_kept  the first of the blocks at the end that are not eliminated; if there are any,
/// the D of the last panel is what remains for them and stays on the bench
/// @param cached  factors with more numbers have a bench
BlockPlan plan_blocks(const BlockRows& rows, const std::vector<int>& host, int first_kept,
                      std::size_t cached = cached_values);

}  // namespace culm::solver
