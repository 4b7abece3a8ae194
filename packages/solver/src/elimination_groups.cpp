#include "elimination_groups.hpp"

#include <culm/math/types.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <limits>
#include <ranges>
#include <set>
#include <utility>

namespace culm::solver {
namespace {

using parallel::Graph;

std::span<const int> neighbours_of(const Graph& graph, int vertex) {
  const int first = graph.begin[index(vertex)];
  return {graph.neighbours.data() + first, index(graph.begin[index(vertex) + 1] - first)};
}

class HostSearch {
 public:
  HostSearch(const Graph& graph, const IsRegular& is_regular)
      : graph_(graph), is_regular_(is_regular), host_(graph.weights.size(), -1) {
    for (int block = 0; block < graph.size(); ++block) members_.push_back({block});
    helpers_.resize(host_.size());
    helped_.resize(host_.size());
    free_.resize(host_.size(), 0);
    for (int block = 0; block < graph.size(); ++block) {
      if (is_regular(members_[index(block)])) continue;
      for (int other : neighbours_of(graph, block)) {
        if (!is_regular(std::array{other, block})) continue;
        helpers_[index(block)].push_back(other);
        helped_[index(other)].push_back(block);
      }
      free_[index(block)] = static_cast<int>(helpers_[index(block)].size());
      open_.insert({free_[index(block)], block});
    }
    while (!open_.empty()) settle(open_.begin()->second);
  }

  std::vector<int> take() { return std::move(host_); }

 private:
  bool is_free(int block) const {
    return members_[index(block)].size() == 1 && host_[index(block)] < 0;
  }

  void settle(int block) {
    open_.erase({free_[index(block)], block});
    int best = -1;
    for (int other : helpers_[index(block)]) {
      if (!is_free(other)) continue;
      if (best < 0 || helped_[index(other)].size() < helped_[index(best)].size()) best = other;
    }
    host_[index(block)] = block;  // waits
    if (best >= 0) {
      join(block, best);
    } else {
      share(block);
    }
  }

  void share(int block) {
    for (int other : helpers_[index(block)]) {
      if (members_[index(other)].size() == 1) continue;  // a guest itself, or it waits
      std::vector<int> together = members_[index(other)];
      together.push_back(block);
      if (!is_regular_(together)) continue;
      join(block, other);
      return;
    }
  }

  void join(int block, int host) {
    const bool was_free = is_free(host);
    host_[index(block)] = host;
    members_[index(host)].push_back(block);
    if (!was_free) return;
    open_.erase({free_[index(host)], host});  // it may have been in need itself
    for (int other : helped_[index(host)]) {
      const auto waiting = open_.find({free_[index(other)], other});
      if (waiting == open_.end()) continue;
      open_.erase(waiting);
      open_.insert({--free_[index(other)], other});
    }
  }

  const Graph& graph_;
  const IsRegular& is_regular_;
  std::vector<int> host_;
  std::vector<std::vector<int>> members_;  // of hosts, themselves first
  std::vector<std::vector<int>> helpers_;  // of a block in need: neighbours that make it regular
  std::vector<std::vector<int>> helped_;   // of a neighbour: whom it would help
  std::vector<int> free_;                  // of an open block: helpers without a guest
  std::set<std::pair<int, int>> open_;     // blocks in need, by free helpers
};

// More neighbours than any group has that is eliminated early.
constexpr int neighbours_of_kept = 64;

// Place of each group: approximate minimum degree. What is kept would be taken for the end of a
// chain, and elimination would begin there and drag it along; so it looks like a part of something
// large.
// @param in_reverse  how AMD is given the groups. Of several ends it takes the last, so that chains
// are then eliminated in the order in which they stand in memory.
std::vector<int> order_by_degree(const Graph& graph, const std::vector<int>& group_of, int count,
                                 bool last_is_kept, bool in_reverse) {
  const int turned = in_reverse ? (last_is_kept ? count - 1 : count) : 0;
  const auto backward = [&](int group) { return group < turned ? turned - 1 - group : group; };
  std::vector<Eigen::Triplet<char, int>> entries;
  for (int block = 0; block < graph.size(); ++block) {
    const int group = backward(group_of[index(block)]);
    entries.emplace_back(group, group, '\1');
    for (int other : neighbours_of(graph, block)) {
      entries.emplace_back(group, backward(group_of[index(other)]), '\1');
    }
  }
  const int imagined = last_is_kept ? neighbours_of_kept : 0;
  for (int i = count - 1; imagined > 0 && i < count + imagined; ++i) {
    for (int k = count - 1; k < count + imagined; ++k) entries.emplace_back(i, k, '\1');
  }
  Eigen::SparseMatrix<char, Eigen::ColMajor, int> pattern(count + imagined, count + imagined);
  pattern.setFromTriplets(entries.begin(), entries.end(), [](char a, char) { return a; });
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  std::vector<int> place(index(count + imagined));
  for (int k = 0; k < count + imagined; ++k) place[index(backward(order.indices()[k]))] = k;
  return place;
}

}  // namespace

std::vector<int> find_hosts(const Graph& graph, const IsRegular& is_regular) {
  return HostSearch(graph, is_regular).take();
}

std::vector<std::vector<int>> order_groups(const Graph& graph, const std::vector<int>& host,
                                           int first_kept) {
  const auto is_guest = [&](int block) {
    return host[index(block)] >= 0 && host[index(block)] != block;
  };
  std::vector<int> group_of(host.size(), -1);
  std::vector<std::vector<int>> groups;
  for (int block = 0; block < first_kept; ++block) {
    if (is_guest(block)) continue;
    group_of[index(block)] = static_cast<int>(groups.size());
    groups.push_back({block});
  }
  for (int block = 0; block < first_kept; ++block) {
    if (!is_guest(block)) continue;
    group_of[index(block)] = group_of[index(host[index(block)])];
    groups[index(group_of[index(block)])].push_back(block);
  }
  const bool keeps_some = first_kept < graph.size();
  if (keeps_some) groups.emplace_back();
  for (int block = first_kept; block < graph.size(); ++block) {
    group_of[index(block)] = static_cast<int>(groups.size()) - 1;
    groups.back().push_back(block);
  }
  // groups of bodies and joints come out larger in reverse
  const bool has_joints = std::ranges::any_of(std::views::iota(0, first_kept), is_guest);
  const std::vector<int> place =
      order_by_degree(graph, group_of, static_cast<int>(groups.size()), keeps_some, !has_joints);
  std::vector<std::pair<int, int>> order;
  for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
    int last = 2 * place[index(group)];
    const int block = groups[index(group)].front();
    if (block >= first_kept) {
      last = std::numeric_limits<int>::max();
    } else if (host[index(block)] == block) {  // it waits
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
