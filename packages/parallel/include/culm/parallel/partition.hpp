/// Which rank owns which vertex of a graph, and in which order vertices are eliminated.
#pragma once

#include <vector>

namespace culm::parallel {

/// An undirected graph without loops: neighbours of vertex v are
/// neighbours[begin[v]] … neighbours[begin[v + 1] - 1].
struct Graph {
  std::vector<int> begin{0};
  std::vector<int> neighbours;
  std::vector<int> weights;  ///< work per vertex, > 0
  int size() const { return static_cast<int>(begin.size()) - 1; }
};

/// Rank of each vertex, by METIS: few edges between ranks, equal weights. Deterministic, so that
/// every rank computes the same. @param ranks number of parts, >= 1
std::vector<int> partition(const Graph& graph, int ranks);

/// Place of each vertex in an order of elimination with little fill: nested dissection by METIS,
/// deterministic.
std::vector<int> dissect(const Graph& graph);

}  // namespace culm::parallel
