#include "ordering.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace culm::solver {
namespace {

std::size_t index(long long i) { return static_cast<std::size_t>(i); }

// Rows that stand together and have the same columns, and those columns.
struct Blocks {
  std::vector<long long> rows;     // global, block after block
  std::vector<int> sizes;          // rows of each block
  std::vector<long long> columns;  // global, block after block
  std::vector<int> widths;         // columns of each block
};

Blocks find_blocks(const assembly::CrsMatrix& matrix) {
  const auto graph = matrix.getLocalMatrixHost().graph;
  const auto columns_of = [&](std::size_t row) {
    return std::span<const int>(graph.entries.data() + graph.row_map(row),
                                graph.row_map(row + 1) - graph.row_map(row));
  };
  Blocks blocks;
  const std::size_t rows = matrix.getRowMap()->getNodeNumElements();
  for (std::size_t row = 0; row < rows; ++row) {
    blocks.rows.push_back(matrix.getRowMap()->getGlobalElement(static_cast<int>(row)));
    const auto columns = columns_of(row);
    if (row > 0 && std::ranges::equal(columns, columns_of(row - 1))) {
      ++blocks.sizes.back();
      continue;
    }
    blocks.sizes.push_back(1);
    blocks.widths.push_back(static_cast<int>(columns.size()));
    for (int column : columns) {
      blocks.columns.push_back(matrix.getColMap()->getGlobalElement(column));
    }
  }
  return blocks;
}

Blocks gather(const Blocks& mine, const parallel::Comm& comm) {
  return {comm.gather(std::span<const long long>(mine.rows)),
          comm.gather(std::span<const int>(mine.sizes)),
          comm.gather(std::span<const long long>(mine.columns)),
          comm.gather(std::span<const int>(mine.widths))};
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

// The graph of the blocks, with an edge where either has an entry in the columns of the other.
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

// Rows of a block follow each other in the order of their numbers.
std::vector<int> place_rows(const parallel::Graph& graph, const std::vector<int>& place_of_block,
                            const std::vector<int>& block_of) {
  std::vector<int> next(index(graph.size()));  // by place of the block
  for (std::size_t b = 0; b < place_of_block.size(); ++b) {
    next[index(place_of_block[b])] = graph.weights[b];
  }
  std::exclusive_scan(next.begin(), next.end(), next.begin(), 0);
  std::vector<int> place(block_of.size());
  for (std::size_t row = 0; row < place.size(); ++row) {
    place[row] = next[index(place_of_block[index(block_of[row])])]++;
  }
  return place;
}

}  // namespace

Ordering order_rows(const assembly::CrsMatrix& matrix, const parallel::Comm& comm) {
  const Blocks blocks = gather(find_blocks(matrix), comm);
  Ordering ordering;
  if (comm.is_root()) {
    const std::vector<int> block_of = block_of_row(blocks);
    const parallel::Graph graph = couple(blocks, block_of);
    const std::vector<int> place_of_block = parallel::dissect(graph);
    ordering.fill = predict_fill(graph, place_of_block);
    ordering.place = place_rows(graph, place_of_block, block_of);
  }
  std::array<double, 2> fill = {ordering.fill.entries, ordering.fill.operations};
  comm.broadcast(fill);
  ordering.fill = {fill[0], fill[1]};
  return ordering;
}

Fill predict_fill(const assembly::CrsMatrix& matrix, const parallel::Comm& comm) {
  return matrix.getGlobalNumRows() == 0 ? Fill{} : order_rows(matrix, comm).fill;
}

}  // namespace culm::solver
