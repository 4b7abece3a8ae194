#include <culm/math/types.hpp>
#include <culm/solver/fill.hpp>

namespace culm::solver {
namespace {

// Rows below the diagonal block of each block column of L. Row k of L reaches from its entries in
// the matrix up the elimination tree, which grows on the way.
std::vector<double> rows_below(const parallel::Graph& graph, const std::vector<int>& place) {
  std::vector<int> vertex_at(place.size());
  for (std::size_t v = 0; v < place.size(); ++v) vertex_at[index(place[v])] = static_cast<int>(v);
  std::vector<int> parent(place.size(), -1);
  std::vector<int> seen_by(place.size(), -1);
  std::vector<double> below(place.size(), 0.0);
  for (int k = 0; k < graph.size(); ++k) {
    const std::size_t v = index(vertex_at[index(k)]);
    seen_by[index(k)] = k;
    for (int e = graph.begin[v]; e < graph.begin[v + 1]; ++e) {
      int j = place[index(graph.neighbours[index(e)])];
      for (; j < k && seen_by[index(j)] != k; j = parent[index(j)]) {
        if (parent[index(j)] < 0) parent[index(j)] = k;
        seen_by[index(j)] = k;
        below[index(vertex_at[index(j)])] += graph.weights[v];
      }
    }
  }
  return below;
}

}  // namespace

Fill predict_fill(const parallel::Graph& graph, const std::vector<int>& place) {
  const std::vector<double> below = rows_below(graph, place);
  Fill fill;
  for (std::size_t v = 0; v < below.size(); ++v) {
    for (int i = 0; i < graph.weights[v]; ++i) {
      const double m = below[v] + i;  // rows under one pivot
      fill.entries += 2.0 * m + 1.0;
      fill.operations += m + 2.0 * m * m;
    }
  }
  return fill;
}

}  // namespace culm::solver
