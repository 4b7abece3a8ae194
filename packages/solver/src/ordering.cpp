#include "ordering.hpp"

#include <culm/math/types.hpp>

#include "blocks.hpp"

#include <array>
#include <numeric>

namespace culm::solver {
namespace {

Blocks gather(const Blocks& mine, const parallel::Comm& comm) {
  return {comm.gather(std::span<const long long>(mine.rows)),
          comm.gather(std::span<const int>(mine.sizes)),
          comm.gather(std::span<const long long>(mine.columns)),
          comm.gather(std::span<const int>(mine.widths))};
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

Fill predict_fill(const assembly::Matrix& matrix, const parallel::Comm& comm) {
  return matrix.rows().total() == 0 ? Fill{} : order_rows(*assembly::tpetra(matrix), comm).fill;
}

}  // namespace culm::solver
