/// Chebyshev iteration with the inverse blocks of nodes.
#pragma once

#include "grid_level.hpp"

#include <vector>

namespace culm::solver {

/// Reduces errors that differ from node to node: a polynomial in D^-1 A that is small between a
/// share of the largest eigenvalue and that value. D are the diagonal blocks of the nodes.
/// @source M. Adams et al., Parallel multigrid smoothing: polynomial versus Gauss-Seidel, 2003
class BlockSmoother {
 public:
  /// Takes the present values, and finds the largest eigenvalue. Collective.
  explicit BlockSmoother(const GridLevel& grid);

  /// Takes new values of the matrix; the eigenvalue stays.
  void refresh();
  /// Whether a node has no block that can be inverted, and is left as it is.
  bool leaves(int node) const { return leaves_[static_cast<std::size_t>(node)]; }
  /// Inverse block of a node, row after row; zero where it is left.
  const double* inverse(int node) const {
    return inverse_.data() + first_[static_cast<std::size_t>(node)];
  }
  /// Of D^-1 A, from below.
  double largest_eigenvalue() const { return largest_; }
  /// x from an x = 0, for A x = b. Collective.
  void smooth(const assembly::Vector& b, assembly::Vector& x);

 private:
  void find_largest();
  void divide(std::span<const double> r, std::span<double> z) const;

  const GridLevel& grid_;
  std::vector<std::size_t> first_;
  std::vector<double> inverse_;
  std::vector<bool> leaves_;
  double largest_ = 1.0;
  assembly::Vector rest_, step_, product_;
};

}  // namespace culm::solver
