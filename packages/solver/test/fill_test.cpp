#include <culm/solver/fill.hpp>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <gtest/gtest.h>

#include <numeric>

namespace culm::solver {
namespace {

// n x n nodes, each coupled with its eight neighbours.
parallel::Graph grid(int n, int unknowns) {
  parallel::Graph graph;
  for (int v = 0; v < n * n; ++v) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = v % n + dx;
        const int y = v / n + dy;
        if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= n || y >= n) continue;
        graph.neighbours.push_back(y * n + x);
      }
    }
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
    graph.weights.push_back(unknowns);
  }
  return graph;
}

// Counts what Gaussian elimination of the dense pattern fills and does.
Fill eliminate(const parallel::Graph& graph, const std::vector<int>& place) {
  std::vector<int> first(place.size());  // row of the first unknown of each block
  for (std::size_t v = 0; v < place.size(); ++v) {
    for (std::size_t w = 0; w < place.size(); ++w) {
      if (place[w] < place[v]) first[v] += graph.weights[w];
    }
  }
  int size = 0;
  for (int weight : graph.weights) size += weight;
  Eigen::MatrixXi pattern = Eigen::MatrixXi::Zero(size, size);
  const auto fill_block = [&](std::size_t v, std::size_t w) {
    pattern.block(first[v], first[w], graph.weights[v], graph.weights[w]).setOnes();
  };
  for (std::size_t v = 0; v < place.size(); ++v) {
    fill_block(v, v);
    for (int e = graph.begin[v]; e < graph.begin[v + 1]; ++e) {
      fill_block(v, static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)]));
    }
  }
  Fill fill;
  for (int k = 0; k < size; ++k) {
    for (int i = k + 1; i < size; ++i) {
      if (pattern(i, k) == 0) continue;
      fill.operations += 1.0;  // the quotient
      for (int j = k + 1; j < size; ++j) {
        if (pattern(k, j) == 0) continue;
        pattern(i, j) = 1;
        fill.operations += 2.0;
      }
    }
  }
  fill.entries = pattern.cast<double>().sum();
  return fill;
}

TEST(Fill, IsWhatEliminationFills) {
  parallel::Graph graph = grid(6, 2);
  graph.weights[7] = 5;
  for (const std::vector<int>& place :
       {parallel::dissect(graph), parallel::dissect(parallel::Graph{graph.begin, {}, {}})}) {
    const Fill predicted = predict_fill(graph, place);
    const Fill counted = eliminate(graph, place);
    EXPECT_EQ(predicted.entries, counted.entries);
    EXPECT_EQ(predicted.operations, counted.operations);
  }
}

TEST(Fill, FrontsOfChainsStayNarrowAndThoseOfSurfacesGrow) {
  parallel::Graph chain;
  for (int v = 0; v < 500; ++v) {
    if (v > 0) chain.neighbours.push_back(v - 1);
    if (v < 499) chain.neighbours.push_back(v + 1);
    chain.begin.push_back(static_cast<int>(chain.neighbours.size()));
    chain.weights.push_back(6);
  }
  const auto front = [](const parallel::Graph& graph) {
    return predict_fill(graph, parallel::dissect(graph)).front();
  };
  EXPECT_LT(front(chain), 18.0);  // a node and its neighbours
  EXPECT_GT(front(grid(20, 6)), 2.0 * front(grid(8, 6)));
}

// A matrix with the pattern of a graph of single unknowns, whose rows stand rank after rank.
assembly::Matrix matrix_of(const parallel::Graph& graph, const parallel::Comm& comm) {
  const int n = graph.size();
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < n; ++v) {
    entries.emplace_back(v, v, 1.0);
    for (int e = graph.begin[static_cast<std::size_t>(v)];
         e < graph.begin[static_cast<std::size_t>(v) + 1]; ++e) {
      entries.emplace_back(v, graph.neighbours[static_cast<std::size_t>(e)], 1.0);
    }
  }
  Eigen::SparseMatrix<double> whole(n, n);
  whole.setFromTriplets(entries.begin(), entries.end());
  const long long first = n * comm.rank() / comm.size(), end = n * (comm.rank() + 1) / comm.size();
  std::vector<long long> mine(static_cast<std::size_t>(end - first));
  std::iota(mine.begin(), mine.end(), first);
  return assembly::Matrix(assembly::Rows(mine, comm), whole);
}

// A chain, of which the last vertices reach to the first as well.
parallel::Graph chain(int size, int reaching) {
  parallel::Graph graph;
  for (int v = 0; v < size; ++v) {
    if (v == 0) {
      for (int w = size - reaching; w < size; ++w) graph.neighbours.push_back(w);
    } else if (v >= size - reaching) {
      graph.neighbours.push_back(0);
    }
    if (v > 0) graph.neighbours.push_back(v - 1);
    if (v + 1 < size) graph.neighbours.push_back(v + 1);
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
    graph.weights.push_back(1);
  }
  return graph;
}

TEST(Fill, IsBoundedByTheEnvelope) {
  const parallel::Comm comm;
  for (const parallel::Graph& graph : {chain(60, 0), chain(60, 5), grid(8, 1)}) {
    std::vector<int> as_it_stands(static_cast<std::size_t>(graph.size()));
    std::iota(as_it_stands.begin(), as_it_stands.end(), 0);
    const Fill bound = bound_fill(matrix_of(graph, comm), comm);
    const Fill counted = eliminate(graph, as_it_stands);
    EXPECT_GE(bound.entries, counted.entries);
    EXPECT_GE(bound.operations, counted.operations);
    if (comm.size() > 1) continue;
    EXPECT_EQ(bound.entries, counted.entries) << "fill leaves no gaps in these";
    EXPECT_EQ(bound.operations, counted.operations);
  }
}

}  // namespace
}  // namespace culm::solver
