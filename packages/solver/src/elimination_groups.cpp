#include "elimination_groups.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace culm::solver {
namespace {

using parallel::Graph;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

std::span<const int> neighbours_of(const Graph& graph, int vertex) {
  const int first = graph.begin[index(vertex)];
  return {graph.neighbours.data() + first, index(graph.begin[index(vertex) + 1] - first)};
}

// Finds a host for hollow blocks, those with the fewest choices first.
class Hosts {
 public:
  Hosts(const Graph& graph, const std::vector<bool>& is_hollow)
      : graph_(graph),
        is_hollow_(is_hollow),
        room_(graph.weights),
        claims_(is_hollow.size(), 0),
        choices_(is_hollow.size(), 0),
        host_(is_hollow.size(), -1) {
    for (int block = 0; block < graph_.size(); ++block) {
      if (!is_hollow_[index(block)]) continue;
      for (int other : neighbours_of(graph_, block)) {
        if (!fits(block, other)) continue;
        ++choices_[index(block)];
        ++claims_[index(other)];
      }
      open_.insert({choices_[index(block)], block});
    }
    while (!open_.empty()) settle(open_.begin()->second);
  }

  // Of each block; -1 if it has none or needs none.
  const std::vector<int>& of_blocks() const { return host_; }

 private:
  bool fits(int block, int other) const {
    return !is_hollow_[index(other)] && room_[index(other)] >= graph_.weights[index(block)];
  }

  void settle(int block) {
    open_.erase({choices_[index(block)], block});
    int best = -1;
    const auto rank = [&](int h) { return std::tuple(claims_[index(h)], -room_[index(h)], h); };
    for (int other : neighbours_of(graph_, block)) {
      if (!fits(block, other)) continue;
      if (best < 0 || rank(other) < rank(best)) best = other;
    }
    if (best < 0) return;
    host_[index(block)] = best;
    for (int other : neighbours_of(graph_, block)) {
      if (fits(block, other)) --claims_[index(other)];
    }
    take_room(best, graph_.weights[index(block)]);
  }

  // Blocks that no longer fit have one choice less.
  void take_room(int host, int size) {
    const int before = room_[index(host)];
    room_[index(host)] -= size;
    for (int other : neighbours_of(graph_, host)) {
      const int needs = graph_.weights[index(other)];
      if (needs > before || needs <= room_[index(host)]) continue;
      const auto waiting = open_.find({choices_[index(other)], other});
      if (waiting == open_.end()) continue;
      open_.erase(waiting);
      --claims_[index(host)];
      open_.insert({--choices_[index(other)], other});
    }
  }

  const Graph& graph_;
  const std::vector<bool>& is_hollow_;
  std::vector<int> room_;     // of hosts: unknowns without a partner
  std::vector<int> claims_;   // of hosts: open blocks that fit
  std::vector<int> choices_;  // of open blocks: hosts that fit
  std::vector<int> host_;
  std::set<std::pair<int, int>> open_;  // choices and block
};

// Place of each group: approximate minimum degree.
std::vector<int> order_by_degree(const Graph& graph, const std::vector<int>& group_of, int count) {
  std::vector<Eigen::Triplet<char, int>> entries;
  for (int block = 0; block < graph.size(); ++block) {
    const int group = group_of[index(block)];
    entries.emplace_back(group, group, '\1');
    for (int other : neighbours_of(graph, block)) {
      entries.emplace_back(group, group_of[index(other)], '\1');
    }
  }
  Eigen::SparseMatrix<char, Eigen::ColMajor, int> pattern(count, count);
  pattern.setFromTriplets(entries.begin(), entries.end(), [](char a, char) { return a; });
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  std::vector<int> place(index(count));
  for (int k = 0; k < count; ++k) place[index(order.indices()[k])] = k;
  return place;
}

}  // namespace

std::vector<std::vector<int>> order_groups(const Graph& graph, const std::vector<bool>& is_hollow) {
  const Hosts hosts(graph, is_hollow);
  std::vector<int> group_of(is_hollow.size(), -1);
  std::vector<std::vector<int>> groups;
  for (int block = 0; block < graph.size(); ++block) {
    if (hosts.of_blocks()[index(block)] >= 0) continue;
    group_of[index(block)] = static_cast<int>(groups.size());
    groups.push_back({block});
  }
  for (int block = 0; block < graph.size(); ++block) {
    const int host = hosts.of_blocks()[index(block)];
    if (host < 0) continue;
    group_of[index(block)] = group_of[index(host)];
    groups[index(group_of[index(block)])].push_back(block);
  }
  const std::vector<int> place = order_by_degree(graph, group_of, static_cast<int>(groups.size()));
  // what has no host waits for its neighbours
  std::vector<std::pair<int, int>> order;
  for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
    int last = 2 * place[index(group)];
    const int block = groups[index(group)].front();
    if (is_hollow[index(block)]) {
      for (int other : neighbours_of(graph, block)) {
        last = std::max(last, 2 * place[index(group_of[index(other)])] + 1);
      }
    }
    order.emplace_back(last, group);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::vector<int>> ordered;
  for (const auto& [last, group] : order) ordered.push_back(std::move(groups[index(group)]));
  return ordered;
}

}  // namespace culm::solver
