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

// The graph of the first vertices alone.
parallel::Graph head(const parallel::Graph& graph, int vertices) {
  parallel::Graph first;
  first.weights.assign(graph.weights.begin(), graph.weights.begin() + vertices);
  for (int v = 0; v < vertices; ++v) {
    for (int e = graph.begin[index(v)]; e < graph.begin[index(v) + 1]; ++e) {
      const int other = graph.neighbours[index(e)];
      if (other < vertices) first.neighbours.push_back(other);
    }
    first.begin.push_back(static_cast<int>(first.neighbours.size()));
  }
  return first;
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

Ordering order_rows(const BlockRows& rows, int kept) {
  const Blocks blocks = find_blocks(rows);
  const std::vector<int> block_of = block_of_row(blocks);
  const parallel::Graph graph = couple(blocks, block_of);
  const int eliminated = kept == 0 ? graph.size() : block_of[block_of.size() - index(kept)];
  std::vector<int> place_of_block = parallel::dissect(head(graph, eliminated));
  for (int b = eliminated; b < graph.size(); ++b) place_of_block.push_back(b);
  return {place_rows(graph, place_of_block, block_of),
          predict_fill(graph, place_of_block, eliminated)};
}

Fill predict_fill(const assembly::Matrix& matrix, const parallel::Comm& comm) {
  return matrix.rows().total() == 0 ? Fill{} : order_rows(*assembly::tpetra(matrix), comm).fill;
}

}  // namespace culm::solver
