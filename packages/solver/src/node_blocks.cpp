#include "node_blocks.hpp"

#include <culm/math/types.hpp>

#include "exchange.hpp"

namespace culm::solver {

void NodeBlocks::add_node(int height) {
  heights.push_back(height);
  first.push_back(blocks.size());
}

double* NodeBlocks::add_block(long long first_unknown, int width) {
  blocks.push_back({first_unknown, width, values.size()});
  first.back() = blocks.size();
  values.resize(values.size() + index(heights.back()) * index(width), 0.0);
  return values.data() + blocks.back().value;
}

NodeBlocks import_nodes(const NodeBlocks& mine, const std::vector<long long>& begin,
                        const std::vector<long long>& wanted, const parallel::Comm& comm) {
  const auto ranks = index(comm.size());
  ByRank<long long> asked(ranks);
  for (long long node : wanted) asked[owner_of(node, begin)].push_back(node);
  const ByRank<long long> questions = exchange_lists(asked, comm);
  ByRank<long long> structure(ranks);
  ByRank<double> numbers(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    for (long long node : questions[rank]) {
      const std::size_t here = index(node - begin[index(comm.rank())]);
      const int height = mine.heights[here];
      structure[rank].push_back(height);
      structure[rank].push_back(static_cast<long long>(mine.first[here + 1] - mine.first[here]));
      for (std::size_t b = mine.first[here]; b < mine.first[here + 1]; ++b) {
        const NodeBlocks::Block& block = mine.blocks[b];
        structure[rank].push_back(block.first_unknown);
        structure[rank].push_back(block.width);
        const double* value = mine.values.data() + block.value;
        numbers[rank].insert(numbers[rank].end(), value, value + height * block.width);
      }
    }
  }
  structure = exchange_lists(structure, comm);
  numbers = exchange_lists(numbers, comm);
  // wanted nodes come rank by rank, each rank's in the order of the question
  std::vector<std::size_t> at(ranks, 0), value(ranks, 0);
  NodeBlocks theirs;
  for (long long node : wanted) {
    const std::size_t rank = owner_of(node, begin);
    const auto next = [&] { return structure[rank][at[rank]++]; };
    const int height = static_cast<int>(next());
    const long long blocks = next();
    theirs.add_node(height);
    for (long long b = 0; b < blocks; ++b) {
      const long long first_unknown = next();
      const int width = static_cast<int>(next());
      double* block = theirs.add_block(first_unknown, width);
      const std::size_t count = index(height) * index(width);
      std::copy_n(numbers[rank].begin() + static_cast<std::ptrdiff_t>(value[rank]), count, block);
      value[rank] += count;
    }
  }
  return theirs;
}

}  // namespace culm::solver
