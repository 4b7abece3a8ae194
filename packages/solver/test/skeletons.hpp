/// Matrices of dense blocks with the graphs of slender models.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace culm::solver {

// Which blocks are coupled, and how many rows each has; those without diagonal are hollow.
struct Skeleton {
  std::string name;
  std::vector<std::pair<int, int>> edges;
  std::vector<int> sizes;
  std::vector<int> hollow;  // numbers of blocks

  int rows() const { return std::accumulate(sizes.begin(), sizes.end(), 0); }
  std::vector<int> block_of_row() const {
    std::vector<int> block_of;
    for (int b = 0; b < static_cast<int>(sizes.size()); ++b) {
      block_of.insert(block_of.end(), static_cast<std::size_t>(sizes[b]), b);
    }
    return block_of;
  }
  bool couples(int a, int b) const {
    return a == b || std::ranges::count(edges, std::pair(a, b)) > 0 ||
           std::ranges::count(edges, std::pair(b, a)) > 0;
  }
};

inline Skeleton chain(int nodes, const std::function<int(int)>& size) {
  Skeleton s{"chain", {}, {}, {}};
  for (int i = 0; i < nodes; ++i) {
    s.sizes.push_back(size(i));
    if (i > 0) s.edges.emplace_back(i - 1, i);
  }
  return s;
}

// The first k nodes may be the parent of node 2 k + 1 and 2 k + 2.
inline Skeleton tree(int nodes, const std::function<int(int)>& size) {
  Skeleton s{"tree", {}, {}, {}};
  for (int i = 0; i < nodes; ++i) {
    s.sizes.push_back(size(i));
    if (i > 0) s.edges.emplace_back((i - 1) / 2, i);
  }
  return s;
}

inline Skeleton loop(int nodes, const std::function<int(int)>& size) {
  Skeleton s = chain(nodes, size);
  s.name = "loop";
  s.edges.emplace_back(nodes - 1, 0);
  return s;
}

// Bodies with a joint between each two that follow each other, closed to a loop or held by the
// first joint. Joints take away 1 to 5 freedoms.
inline Skeleton bodies(int count, bool closed) {
  Skeleton s{closed ? "closed bodies" : "bodies", {}, std::vector<int>(count, 6), {}};
  for (int i = 0; i < count; ++i) {
    const int joint = count + i;
    s.sizes.push_back(1 + i % 5);
    s.hollow.push_back(joint);
    s.edges.emplace_back(i, joint);
    if (i > 0) s.edges.emplace_back(i - 1, joint);
    if (i == 0 && closed) s.edges.emplace_back(count - 1, joint);
  }
  return s;
}

// All blocks within an edge are full; the diagonal is as large as a row, but not so large that no
// pivots are needed.
inline Eigen::MatrixXd random_values(const Skeleton& s, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<int> first(s.sizes.size());
  std::exclusive_scan(s.sizes.begin(), s.sizes.end(), first.begin(), 0);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(s.rows(), s.rows());
  const auto fill = [&](int a, int b) {
    auto block = A.block(first[a], first[b], s.sizes[a], s.sizes[b]);
    for (int i = 0; i < block.size(); ++i) block(i % s.sizes[a], i / s.sizes[a]) = uniform(random);
  };
  for (int b = 0; b < static_cast<int>(s.sizes.size()); ++b) {
    if (std::ranges::count(s.hollow, b) > 0) continue;
    fill(b, b);
    A.block(first[b], first[b], s.sizes[b], s.sizes[b]).diagonal().array() += 3.0;
  }
  for (const auto& [a, b] : s.edges) {
    fill(a, b);
    fill(b, a);
  }
  return A;
}

inline std::vector<Skeleton> skeletons() {
  const auto any = [](int i) { return 1 + (7 * i) % 9; };
  const auto node = [](int) { return 6; };
  std::vector<Skeleton> all;
  for (const int n : {1, 2, 3, 20}) {
    for (const auto& make : {chain, tree}) {
      all.push_back(make(n, any));
      all.push_back(make(n, node));
    }
    all.push_back(bodies(n, false));
  }
  for (const int n : {3, 4, 20}) {
    all.push_back(loop(n, any));
    all.push_back(loop(n, node));
    all.push_back(bodies(n, true));
  }
  for (int size = 1; size <= 9; ++size) {
    all.push_back(loop(7, [size](int) { return size; }));
    all.push_back(chain(7, [size](int) { return size; }));
  }
  return all;
}

}  // namespace culm::solver
