/// Everything about factors of dense blocks that follows from the graph.
#pragma once

#include "block_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace culm::solver {

/// Numbers of a line of the cache.
constexpr std::size_t numbers_of_line = 8;

/// So many numbers, rounded up to whole lines, of which no two panels share one.
constexpr std::size_t whole_lines(std::size_t count) {
  return (count + numbers_of_line - 1) / numbers_of_line * numbers_of_line;
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
  /// Places, of numbers unless said otherwise. The plan is read with every factorisation, so that
  /// it is kept short.
  using Place = std::uint32_t;

  struct Panel {
    int size = 0;      ///< unknowns of the group
    int width = 0;     ///< columns of U, rows of L
    int first = 0;     ///< place of its first unknown in the order of elimination
    int row = 0;       ///< its first unknown, if the others follow it; else -1
    Place beside = 0;  ///< its part of `beside`
    Place pivot = 0;   ///< [D U] where it is made; L follows
    /// V, and D with L behind it, where they stay when they come from a bench; in whole lines and
    /// each counted for itself.
    Place line_of_V = 0;
    Place line_of_D = 0;
    /// Ends of its updates, and of the copies and gaps that are to be done before it is eliminated;
    /// they begin where those of the panel before end.
    Place updates = 0;
    Place copies = 0;
    Place gaps = 0;
    int stride() const { return size + width; }
    /// L where it is made.
    std::size_t below() const {
      return pivot + static_cast<std::size_t>(size) * static_cast<std::size_t>(stride());
    }
  };
  /// target -= L V, for some rows of L and some columns of V, where panels are made.
  struct Update {
    Place below = 0;   ///< first row of L
    Place beside = 0;  ///< first column of V
    Place target = 0;
    int stride = 0;  ///< of the target
    int rows = 0;
    int columns = 0;
  };
  /// A rectangle of the matrix that goes to where a panel is made.
  struct Copy {
    Place source = 0;  ///< of the first entry, see BlockRows
    Place target = 0;
    int source_stride = 0;
    int target_stride = 0;
    int rows = 0;
    int columns = 0;
  };
  /// What the matrix leaves empty in a panel and updates may fill.
  struct Gap {
    Place target = 0;
    Place size = 0;
  };
  /// Rows of the matrix that follow each other in the order of elimination, too.
  struct Run {
    int row = 0;
    int count = 0;
  };

  std::vector<Panel> panels;
  std::vector<int> unknown;  ///< by place in the order of elimination
  std::vector<Run> runs;     ///< the same
  std::vector<int> beside;   ///< places of the columns of each U
  std::vector<Update> updates;
  std::vector<Copy> copies;
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
/// Throws NumericalError where there is more than a Place can tell.
BlockPlan plan_blocks(const BlockRows& rows, const std::vector<int>& host, int first_kept,
                      std::size_t cached = cached_values);

}  // namespace culm::solver
