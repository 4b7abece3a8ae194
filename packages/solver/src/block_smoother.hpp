/// Chebyshev iteration with the inverse blocks of nodes.
#pragma once

#include "patch_modes.hpp"

#include <optional>
#include <vector>

namespace culm::solver {

/// Reduces errors that differ from node to node: a polynomial in M A that is small between a
/// share of the largest eigenvalue and that value. M are the inverse diagonal blocks D^-1 of the
/// nodes, and the soft modes of patches where there are some.
/// @source M. Adams et al., Parallel multigrid smoothing: polynomial versus Gauss-Seidel, 2003
class BlockSmoother {
 public:
  /// Takes the present values, and finds the largest eigenvalue. Collective.
  explicit BlockSmoother(const GridLevel& grid);

  /// Takes the soft modes of patches, too. @param carried  as for PatchModes. Collective.
  void add_modes(const std::vector<bool>& carried, const parallel::Comm& comm);
  /// Whether there are any, on any rank.
  bool has_modes() const { return modes_.has_value(); }
  /// Takes new values of the matrix for the blocks; modes and eigenvalues stay.
  void refresh();
  /// Whether a node has no block that can be inverted, and is left as it is.
  bool leaves(int node) const { return leaves_[static_cast<std::size_t>(node)]; }
  /// Inverse block of a node, column after column; zero where it is left.
  const float* inverse(int node) const {
    return inverse_.data() + first_[static_cast<std::size_t>(node)];
  }
  /// Of D^-1 A, from below.
  double largest_eigenvalue() const { return largest_; }
  /// x from an x = 0, for A x = b. Collective.
  void smooth(const assembly::Vector& b, assembly::Vector& x);
  /// x from the x that is there. Collective.
  void smooth_further(const assembly::Vector& b, assembly::Vector& x);
  /// b - A x after that. Collective; once.
  const assembly::Vector& find_rest();

 private:
  double find_largest();
  void improve(const assembly::Vector& rest, assembly::Vector& x);
  void advance(double of_product, double of_step, assembly::Vector& x);
  void precondition(const assembly::Vector& r, assembly::Vector& z);

  const GridLevel& grid_;
  std::vector<std::size_t> first_;
  // In single precision, as the matrix of the steps: it is enough for these, as they are not
  // smooth, and they wait for memory.
  std::vector<float> inverse_;
  RoundedMatrix matrix_;
  std::vector<bool> leaves_;
  std::optional<PatchModes> modes_;
  double largest_ = 1.0;  // of D^-1 A
  double upper_ = 1.0;    // of M A
  assembly::Vector rest_, step_, product_;
};

}  // namespace culm::solver
