/// Director beam that does without some of its strains.
#pragma once

#include <culm/beam/director_beam.hpp>
#include <culm/beam/held_strains.hpp>

#include <array>

namespace culm::beam {

/// DirectorBeam of the same order of whose six strains only `Count` ones from `First` on are free:
/// the other ones are held by the constraints of hold_strains() at the same points. Their forces
/// are multipliers, so that the free strains alone have resultants.
template <int Order, int First, int Count>
class HeldBeam {
 public:
  static_assert((First == 0 || First == 3) && (First + Count == 6 || First + Count == 5));
  using Base = DirectorBeam<Order>;
  static constexpr HeldStrains held{First == 3, First + Count == 5};
  static constexpr int first_strain = First;
  static constexpr NodeKind node_kind = Base::node_kind;
  static constexpr int num_nodes = Base::num_nodes;
  static constexpr int num_slots = Base::num_slots;
  static constexpr int num_points = Base::num_points;
  static constexpr int num_strains = Count;
  static constexpr int num_resultants = Count;
  static constexpr model::TurnKind turn_kind = Base::turn_kind;

  using Strain = Vec<num_strains>;
  using Nodes = typename Base::Nodes;

  explicit HeldBeam(const Base& base);

  /// Those of (Γ1, Γ2, Γ3, K1, K2, K3) that are free, minus reference [-, 1/m]
  void strain(int point, const Nodes& q, Strain& e) const noexcept;
  void gradient(int point, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept;
  void add_curvature(int point, const Strain& S, SlotMatrix<num_slots>& A) const noexcept;
  /// Never fails
  Verdict respond(int point, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<num_strains>& response) const noexcept;
  /// w C of a point against the free strains
  const RowMat<Count, Count>& stiffness(int point) const noexcept {
    return stiffness_[static_cast<std::size_t>(point)];
  }
  double energy(int point, const Strain& e) const noexcept;
  SlotMatrix<num_slots> mass() const noexcept { return base_.mass(); }

  /// C e, components in the section triad [N, N m]
  Strain resultants(int point, const Strain& e) const noexcept;
  static constexpr std::array<const char*, num_resultants> resultant_names() {
    std::array<const char*, num_resultants> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = Base::resultant_names()[First + i];
    return names;
  }

  template <class SlotsAt>
  static double least_cosine(const SlotsAt& at) noexcept {
    return Base::least_cosine(at);
  }

 private:
  Base base_;
  std::array<RowMat<Count, Count>, num_points> stiffness_;
};

/// Bends and twists.
template <int Order>
using KirchhoffBeam = HeldBeam<Order, 3, 3>;
/// Shears, stretches and bends.
template <int Order>
using UntwistedBeam = HeldBeam<Order, 0, 5>;
/// Bends.
template <int Order>
using UntwistedKirchhoffBeam = HeldBeam<Order, 3, 2>;

extern template class HeldBeam<1, 3, 3>;
extern template class HeldBeam<2, 3, 3>;
extern template class HeldBeam<3, 3, 3>;
extern template class HeldBeam<1, 0, 5>;
extern template class HeldBeam<2, 0, 5>;
extern template class HeldBeam<3, 0, 5>;
extern template class HeldBeam<1, 3, 2>;
extern template class HeldBeam<2, 3, 2>;
extern template class HeldBeam<3, 3, 2>;

static_assert(Element<KirchhoffBeam<1>> && HasStiffness<UntwistedBeam<1>> &&
              HasResultants<UntwistedKirchhoffBeam<1>>);

}  // namespace culm::beam
