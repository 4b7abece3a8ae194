/// What a sparse factorisation will cost, from the graph alone.
#pragma once

#include <culm/assembly/matrix.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/parallel/partition.hpp>

#include <vector>

namespace culm::solver {

/// Size and work of the factors L and U.
struct Fill {
  double entries = 0.0;     ///< of L and U together
  double operations = 0.0;  ///< additions and multiplications
  /// Mean length of a column of L where the work is done: about 15 in a chain of nodes with six
  /// unknowns, whatever its length; it grows with the width of a surface.
  double front() const { return entries > 0.0 ? operations / entries : 0.0; }
};

/// Fill without pivoting of a matrix of dense blocks. The vertices of the graph are the blocks,
/// their weights the rows of each. @param place of each vertex in the order of elimination
/// @param eliminated  of the vertices, the first ones; the others are kept
/// @source J. W. H. Liu, The role of elimination trees in sparse factorization, 1990
Fill predict_fill(const parallel::Graph& graph, const std::vector<int>& place, int eliminated);
inline Fill predict_fill(const parallel::Graph& graph, const std::vector<int>& place) {
  return predict_fill(graph, place, graph.size());
}
/// The same of a matrix in the order that MUMPS takes, nested dissection. Collective.
Fill predict_fill(const assembly::Matrix& matrix, const parallel::Comm& comm);
/// The same from above, for an order that nobody had to find: rows as they stand, rank after rank,
/// with a pattern that is symmetric. Factors stay within the envelope of the matrix; rows that
/// reach to other ranks count in all columns. Takes one look at each entry. Collective.
/// @source A. George, J. W. H. Liu, Computer Solution of Large Sparse Positive Definite Systems,
/// 1981, ch. 4
Fill bound_fill(const assembly::Matrix& matrix, const parallel::Comm& comm);

}  // namespace culm::solver
