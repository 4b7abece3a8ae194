/// Shell with small displacements from a frame that moves along.
#pragma once

#include <culm/shell/elastic_shell.hpp>

#include <vector>

namespace culm::shell {

/// ElasticShell whose strains are linear in the displacements seen from a frame node: with its
/// directors R, the modes have the components R^T p_j, which are the forms of the element,
///   y_j = R^T p_j - reference,  j = 1 ... 7,
/// and the products of modes follow to first order,
///   p_i . p_j = P_i . y_j + P_j . y_i,    P in the reference,
/// so the law is a constant again. The forms are quadratic, and blind to rigid motions of shell and
/// frame together; so the step keeps energy and momenta as it does for the full shell. Good for
/// small rotations against the frame.
///
/// Node 0 is the frame, a triad; the others are those of the shell, with two empty slots each.
class LinearShell {
 public:
  static constexpr NodeKind node_kind = NodeKind::node12;
  static constexpr int num_nodes = 1 + ShellForms::num_nodes;
  static constexpr int num_slots = num_nodes * slots_of(node_kind);
  static constexpr int num_points = 1;
  static constexpr int num_strains = 3 * ShellForms::num_modes;
  static constexpr int num_resultants = ElasticShell::num_resultants;

  using Strain = Vec<num_strains>;
  using Nodes = Slots<num_slots>;
  using Stiffness = RowMat<num_strains, num_strains>;

  /// @param reference  of frame and shell, free of stress; the frame is orthonormal
  LinearShell(const ElasticShell& full, const Nodes& reference);

  void strain(int point, const Nodes& q, Strain& y) const noexcept;
  void gradient(int point, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept;
  void add_curvature(int point, const Strain& S, SlotMatrix<num_slots>& A) const noexcept;
  /// f += B(q) S, one column per slot
  static void add_force(const Nodes& q, const Strain& S, Nodes& f) noexcept;
  /// K += factor B(mid) C B(next)^T in the unknowns of the nodes, see ActsOnUnknowns
  static void add_stiffness(const Nodes& mid, const Nodes& next, const Stiffness& C, double factor,
                            RowMat<6 * num_nodes, 6 * num_nodes>& K) noexcept;

  /// S = C ((1 - ϑ) y_prev + ϑ y_next); never fails
  Verdict respond(int point, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<num_strains>& response) const noexcept;
  /// The constant C of the law: symmetric, stress = C y at rest.
  Stiffness stiffness(int) const noexcept { return stiffness_.full(); }
  /// As of the full shell.
  Stiffness branch_stiffness(int, std::size_t branch) const noexcept {
    return branches_[branch].full();
  }
  double energy(int point, const Strain& y) const noexcept;
  SlotMatrix<num_slots> mass() const noexcept;

  ShellResultants resultants(int, const Strain& y) const noexcept {
    return wall_.resultants(products(y));
  }
  static constexpr const auto& resultant_names() { return shell_resultant_names; }
  /// At the centre of the element, at `height` within a layer: -1 bottom, 0 middle, 1 top.
  LayerState layer_state(int layer, double height, const Strain& y) const {
    return wall_.layer_state(layer, height, products(y));
  }
  const material::Layup& layup() const { return *wall_.layup; }
  const ElasticWall& wall() const { return wall_; }
  /// A stress against the forms of the full shell, against those seen from the frame.
  Strain seen_from_frame(const ShellForms::Strain& stress) const noexcept;

 private:
  /// Forms of the full shell, to first order.
  ShellForms::Strain products(const Strain& y) const noexcept;

  ShellForms::Modes reference_;  // P, seen from the frame
  ElasticWall wall_;
  Symmetric<num_strains> stiffness_;
  std::vector<Symmetric<num_strains>> branches_;
  SlotMatrix<ShellForms::num_slots> mass_;
};

static_assert(Element<LinearShell> && HasResultants<LinearShell>);
static_assert(HasStiffness<LinearShell> && ActsOnUnknowns<LinearShell>);

}  // namespace culm::shell
