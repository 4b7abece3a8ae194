#include <culm/assembly/tpetra.hpp>
#include <culm/math/types.hpp>
#include <culm/solver/fill.hpp>

#include <algorithm>
#include <array>

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

// @param below rows of L under the diagonal
void add_column(double below, Fill& fill) {
  fill.entries += 2.0 * below + 1.0;
  fill.operations += below + 2.0 * below * below;
}

}  // namespace

Fill predict_fill(const parallel::Graph& graph, const std::vector<int>& place, int eliminated) {
  const std::vector<double> below = rows_below(graph, place);
  Fill fill;
  for (std::size_t v = 0; v < index(eliminated); ++v) {
    for (int i = 0; i < graph.weights[v]; ++i) add_column(below[v] + i, fill);
  }
  return fill;
}

Fill bound_fill(const assembly::Matrix& matrix, const parallel::Comm& comm) {
  const auto graph = assembly::tpetra(matrix)->getLocalMatrixHost().graph;
  const int rows = static_cast<int>(graph.numRows());
  std::vector<int> change(index(rows), 0);  // of the rows of L, from column to column
  double beyond = 0.0;
  for (int row = 0; row < rows; ++row) {
    int first = row;
    bool reaches_others = false;
    for (auto k = graph.row_map(row); k < graph.row_map(row + 1); ++k) {
      const int column = graph.entries(k);
      reaches_others |= column >= rows;
      first = std::min(first, column);
    }
    ++change[index(first)];
    --change[index(row)];
    if (reaches_others) beyond += 1.0;
  }
  double below = comm.sum(beyond);
  Fill fill;
  for (const int more : change) {
    below += more;
    add_column(below, fill);
  }
  std::array<double, 2> sums = {fill.entries, fill.operations};
  comm.sum(sums);
  return {sums[0], sums[1]};
}

}  // namespace culm::solver
