#include "aggregates.hpp"

#include <culm/math/types.hpp>

#include <algorithm>
#include <utility>

namespace culm::solver {
namespace {

constexpr int none = -1;

class Aggregator {
 public:
  Aggregator(const GridLevel& grid, const std::vector<bool>& carried)
      : grid_(grid), carried_(carried) {
    result_.of_node.assign(index(grid.nodes()), none);
  }

  Aggregates run() && {
    for (int node = 0; node < grid_.nodes(); ++node) {
      if (carried_[index(node)]) result_.of_node[index(node)] = result_.count++;
    }
    for (int node = 0; node < grid_.nodes(); ++node) {
      if (is_free(node) && !has_taken_neighbour(node)) begin_at(node);
    }
    const std::vector<int> first = result_.of_node;
    for (int node = 0; node < grid_.nodes(); ++node) {
      if (is_free(node)) result_.of_node[index(node)] = nearest(node, first);
    }
    for (int node = 0; node < grid_.nodes(); ++node) {
      if (is_free(node)) begin_at(node);
    }
    return std::move(result_);
  }

 private:
  bool is_free(int node) const { return result_.of_node[index(node)] == none; }

  // Calls action(other) for the neighbours on this rank that are not carried.
  template <class Action>
  void each_neighbour(int node, Action action) const {
    int last = node;
    for (int column : grid_.rows().columns(node)) {
      const int other = grid_.node_of(column);
      if (other == last || other == node || other >= grid_.nodes()) continue;
      last = other;
      if (!carried_[index(other)]) action(other);
    }
  }

  bool has_taken_neighbour(int node) const {
    bool found = false;
    each_neighbour(node, [&](int other) { found = found || !is_free(other); });
    return found;
  }

  void begin_at(int node) {
    const int number = result_.count++;
    result_.of_node[index(node)] = number;
    each_neighbour(node, [&](int other) {
      if (is_free(other)) result_.of_node[index(other)] = number;
    });
  }

  int nearest(int node, const std::vector<int>& aggregates) const {
    std::vector<std::pair<int, int>> votes;  // aggregate, neighbours in it
    each_neighbour(node, [&](int other) {
      const int number = aggregates[index(other)];
      if (number == none) return;
      const auto same = [&](const auto& vote) { return vote.first == number; };
      const auto found = std::ranges::find_if(votes, same);
      if (found == votes.end()) {
        votes.emplace_back(number, 1);
      } else {
        ++found->second;
      }
    });
    const auto by_count = [](const auto& vote) { return vote.second; };
    return votes.empty() ? none : std::ranges::max_element(votes, {}, by_count)->first;
  }

  const GridLevel& grid_;
  const std::vector<bool>& carried_;
  Aggregates result_;
};

}  // namespace

Aggregates aggregate(const GridLevel& grid, const std::vector<bool>& carried) {
  return Aggregator(grid, carried).run();
}

}  // namespace culm::solver
