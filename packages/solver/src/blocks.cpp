#include "blocks.hpp"

#include <culm/math/types.hpp>

#include <algorithm>

namespace culm::solver {

Blocks find_blocks(const BlockRows& rows) {
  Blocks blocks;
  std::vector<int> columns, last;
  std::size_t end = 0;  // of the sources of the row before
  for (int row = 0; row < rows.size(); ++row) {
    columns.clear();
    bool follows = row > 0;
    rows.for_entries(row, [&](int column, std::size_t source) {
      if (columns.empty()) follows = follows && source == end;
      columns.push_back(column);
      end = source + 1;
    });
    std::ranges::sort(columns);
    blocks.rows.push_back(row);
    if (follows && columns == last) {
      ++blocks.sizes.back();
      continue;
    }
    blocks.sizes.push_back(1);
    blocks.widths.push_back(static_cast<int>(columns.size()));
    blocks.columns.insert(blocks.columns.end(), columns.begin(), columns.end());
    last.swap(columns);
  }
  return blocks;
}

Blocks find_blocks(const assembly::CrsMatrix& matrix) {
  Blocks blocks = find_blocks(BlockRows(matrix));
  for (long long& row : blocks.rows) {
    row = matrix.getRowMap()->getGlobalElement(static_cast<int>(row));
  }
  for (long long& column : blocks.columns) {
    column = matrix.getColMap()->getGlobalElement(static_cast<int>(column));
  }
  return blocks;
}

std::vector<int> block_of_row(const Blocks& blocks) {
  std::vector<int> block_of(blocks.rows.size());
  std::size_t at = 0;
  for (std::size_t b = 0; b < blocks.sizes.size(); ++b) {
    for (int i = 0; i < blocks.sizes[b]; ++i) {
      block_of[index(blocks.rows[at++])] = static_cast<int>(b);
    }
  }
  return block_of;
}

parallel::Graph couple(const Blocks& blocks, const std::vector<int>& block_of) {
  std::vector<std::vector<int>> neighbours(blocks.sizes.size());
  std::size_t at = 0;
  for (std::size_t b = 0; b < blocks.sizes.size(); ++b) {
    int last = static_cast<int>(b);
    for (int k = 0; k < blocks.widths[b]; ++k) {
      const int other = block_of[index(blocks.columns[at++])];
      if (other == last || other == static_cast<int>(b)) continue;  // a run of columns of one block
      neighbours[b].push_back(other);
      neighbours[index(other)].push_back(static_cast<int>(b));
      last = other;
    }
  }
  parallel::Graph graph;
  graph.weights = blocks.sizes;
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    graph.neighbours.insert(graph.neighbours.end(), list.begin(), list.end());
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
  }
  return graph;
}

}  // namespace culm::solver
