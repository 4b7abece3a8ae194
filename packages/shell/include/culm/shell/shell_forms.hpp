/// The quadratic forms of the four-node shell, and all that follows from them without a law.
#pragma once

#include <culm/mechanics/element.hpp>

namespace culm::shell {

/// The deformation of a bilinear shell x + ζ d is made of seven vectors, its modes
///   x1, x2, x3   parts of the position with ξ, η, ξη  [m]
///   d0, ..., d3  parts of the director with 1, ξ, η, ξη  [-]
/// and all strain components, at any point, sampled or not, are sums of their dot products. So the
/// 28 products are the forms of the element:
///   y_ij = p_i . p_j  for i < j,   y_ii = 1/2 p_i . p_i,   reference values subtracted,
/// with the derivatives ∂y_ij/∂p_i = p_j. A law integrated over the element once answers them, and
/// its cost does not depend on the number of points or layers behind it.
///
/// Nodes run counter-clockwise from (ξ, η) = (-1, -1); slots of a node: x, d.
/// @source formulation 1.4.1
class ShellForms {
 public:
  static constexpr NodeKind node_kind = NodeKind::node6;
  static constexpr int num_nodes = 4;
  static constexpr int num_slots = num_nodes * slots_of(node_kind);
  static constexpr int num_points = 1;
  static constexpr int num_modes = 7;
  static constexpr int num_strains = num_modes * (num_modes + 1) / 2;

  using Strain = Vec<num_strains>;
  using Nodes = Slots<num_slots>;
  /// Columns x1, x2, x3, d0, d1, d2, d3.
  using Modes = Mat<3, num_modes>;
  using Stiffness = RowMat<num_strains, num_strains>;

  /// Place of y_ij among the forms: the upper triangle by rows.
  static constexpr int form(int i, int j) {
    return i <= j ? i * num_modes - i * (i - 1) / 2 + j - i : form(j, i);
  }
  static Modes modes(const Nodes& q) noexcept;

  /// @param reference  stress-free nodes
  explicit ShellForms(const Nodes& reference) noexcept : reference_(products(modes(reference))) {}

  void strain(int point, const Nodes& q, Strain& y) const noexcept;
  void gradient(int point, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept;
  void add_curvature(int point, const Strain& S, SlotMatrix<num_slots>& A) const noexcept;

  // The gradient is sparse in the modes but not in the nodes. What batches need it for is offered
  // without it, several times faster:

  /// f += B(q) S, one column per slot
  static void add_force(const Nodes& q, const Strain& S, Nodes& f) noexcept;
  /// K += factor B(mid) C B(next)^T; C need not be symmetric
  static void add_stiffness(const Nodes& mid, const Nodes& next, const Stiffness& C, double factor,
                            RowMat<3 * num_slots, 3 * num_slots>& K) noexcept;

 private:
  static Strain products(const Modes& p) noexcept;

  Strain reference_;
};

}  // namespace culm::shell
