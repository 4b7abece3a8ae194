/// Director beam with small displacements from a frame that moves along.
#pragma once

#include <culm/beam/director_beam.hpp>

namespace culm::beam {

/// DirectorBeam whose strains are linear in the displacements seen from a frame node: with its
/// directors R and its place x0, a slot of the beam has the components
///   s = R^T (x - x0) or R^T d,     y = B0^T (s - s_ref),     B0 = ∂(Γ, K)/∂q in the reference,
/// of directors by their turn alone, ½ Σ D_i x d_i, so that normal forces neither stiffen nor
/// soften the beam. The forms are quadratic, and blind to rigid motions of beam and frame together;
/// so the step keeps energy and momenta as it does for the full beam. Good for small rotations
/// against the frame.
///
/// Node 0 is the frame, the others those of the beam, one of which may be the same node.
template <int Order>
class LinearBeam {
 public:
  using Base = DirectorBeam<Order>;
  static constexpr NodeKind node_kind = Base::node_kind;
  static constexpr int num_nodes = 1 + Base::num_nodes;
  static constexpr int num_slots = 4 + Base::num_slots;
  static constexpr int num_points = Base::num_points;
  static constexpr int num_strains = 6;
  static constexpr int num_resultants = 6;
  /// Directors turn by sin Δ instead of Δ, so the whole beam behaves as one element of order 1.
  static constexpr model::TurnKind turn_kind{1, true};

  using Strain = Vec<num_strains>;
  using Nodes = Slots<num_slots>;

  /// @param reference  of frame and beam, free of stress; orthonormal triads
  LinearBeam(const Base& base, const Nodes& reference);

  /// (Γ1, Γ2, Γ3, K1, K2, K3) minus reference, to first order [-, 1/m]
  void strain(int point, const Nodes& q, Strain& e) const noexcept;
  void gradient(int point, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept;
  void add_curvature(int point, const Strain& S, SlotMatrix<num_slots>& A) const noexcept;
  /// Never fails
  Verdict respond(int point, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<num_strains>& response) const noexcept {
    return base_.respond(point, prev, next, stencil, response);
  }
  /// w C of a point
  RowMat<6, 6> stiffness(int point) const noexcept { return base_.stiffness(point); }
  double energy(int point, const Strain& e) const noexcept { return base_.energy(point, e); }
  SlotMatrix<num_slots> mass() const noexcept;

  /// C e, components in the section triad [N, N m]
  Vec6 resultants(int point, const Strain& e) const noexcept { return base_.resultants(point, e); }
  static constexpr std::array<const char*, num_resultants> resultant_names() {
    return Base::resultant_names();
  }

  /// Cosine of the largest turn of a node against the frame, from where it stood in the reference.
  /// @see HasTurn
  template <class SlotsAt>
  double least_cosine(const SlotsAt& at) const noexcept {
    Nodes q;
    for (int a = 0; a < num_nodes; ++a) q.template middleCols<4>(4 * a) = at(a);
    const Local local = in_frame(q);
    double least = 1.0;
    for (int s = 0; s < beam_slots; s += 4) {
      least = std::min(least, model::cosine_between(local.template middleCols<4>(s),
                                                    reference_.template middleCols<4>(s)));
    }
    return least;
  }

 private:
  static constexpr int beam_slots = Base::num_slots;
  using Local = Mat<3, beam_slots>;

  static Local in_frame(const Nodes& q) noexcept;
  static bool is_place(int slot) noexcept { return slot % 4 == 0; }

  Base base_;
  std::array<Gradient<beam_slots, num_strains>, num_points> gradient_;  // B0, in the frame
  Local reference_;
};

extern template class LinearBeam<1>;
extern template class LinearBeam<2>;
extern template class LinearBeam<3>;

static_assert(Element<LinearBeam<1>> && HasStiffness<LinearBeam<1>> &&
              HasResultants<LinearBeam<1>>);

}  // namespace culm::beam
