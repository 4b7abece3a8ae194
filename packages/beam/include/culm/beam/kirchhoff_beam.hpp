/// Director beam without shear and extension.
#pragma once

#include <culm/beam/director_beam.hpp>
#include <culm/model/constraint.hpp>

#include <string>

namespace culm::beam {

/// Bends and twists as DirectorBeam of the same order; its axis neither stretches nor shears, which
/// shear_free() holds by constraints at the same points. Forces are their multipliers, so that
/// moments are the only resultants; with coupled sections the law is that of Γ = 0, the block of
/// bending and torsion.
template <int Order>
class KirchhoffBeam {
 public:
  using Base = DirectorBeam<Order>;
  static constexpr NodeKind node_kind = Base::node_kind;
  static constexpr int num_nodes = Base::num_nodes;
  static constexpr int num_slots = Base::num_slots;
  static constexpr int num_points = Base::num_points;
  static constexpr int num_strains = 3;
  static constexpr int num_resultants = 3;
  static constexpr model::TurnKind turn_kind = Base::turn_kind;

  using Strain = Vec<num_strains>;
  using Nodes = typename Base::Nodes;

  explicit KirchhoffBeam(const Base& base);

  /// (K1, K2, K3) minus reference [1/m]
  void strain(int point, const Nodes& q, Strain& e) const noexcept;
  void gradient(int point, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept;
  void add_curvature(int point, const Strain& S, SlotMatrix<num_slots>& A) const noexcept;
  /// Never fails
  Verdict respond(int point, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<num_strains>& response) const noexcept;
  /// w C of a point
  const RowMat<3, 3>& stiffness(int point) const noexcept {
    return stiffness_[static_cast<std::size_t>(point)];
  }
  double energy(int point, const Strain& e) const noexcept;
  SlotMatrix<num_slots> mass() const noexcept { return base_.mass(); }

  /// C e, components in the section triad [N m]
  Vec3 resultants(int point, const Strain& e) const noexcept;
  static constexpr std::array<const char*, num_resultants> resultant_names() {
    return {"M1", "M2", "M3"};
  }

  static double least_cosine(const Nodes& q) noexcept { return Base::least_cosine(q); }

 private:
  Base base_;
  std::array<RowMat<3, 3>, num_points> stiffness_;
};

/// Γ = d_i . x' - reference = 0 at the points of an element: three rows each.
/// @param nodes      numbers in the model
/// @param reference  their slots, free of stress
template <int Order>
model::Constraint shear_free(const std::string& name, const DirectorBeam<Order>& element,
                             const std::array<int, Order + 1>& nodes,
                             const typename DirectorBeam<Order>::Nodes& reference);

extern template class KirchhoffBeam<1>;
extern template class KirchhoffBeam<2>;
extern template class KirchhoffBeam<3>;

static_assert(Element<KirchhoffBeam<1>> && HasStiffness<KirchhoffBeam<1>> &&
              HasResultants<KirchhoffBeam<1>>);

}  // namespace culm::beam
