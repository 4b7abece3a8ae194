/// Director beams side by side.
#pragma once

#include <culm/beam/director_beam.hpp>
#include <culm/mechanics/pack.hpp>

#include <array>

namespace culm::beam {

/// Elements of one order in a pack. Forces and tangents are those that ElementBatch makes of the
/// strains, their gradients and curvatures, in closed form. @source formulation 1.3.1, 5.2
template <int Order>
class DirectorPack {
 public:
  static constexpr int num_nodes = Order + 1;
  using Motion = PackMotion<num_nodes>;
  using Sum = PackSum<num_nodes>;

  explicit DirectorPack(const std::array<const DirectorBeam<Order>*, pack_lanes>& elements);

  /// @see ComesInPacks
  /// @param predicted  stress that the tangent is to have, shape (Order, 6), or nullptr
  void evaluate(const Motion& motion, const Pack* predicted, const Stencil& stencil,
                bool with_tangent, Sum& sum) const noexcept;
  /// @param increment  of the slots, shape (12 num_nodes)
  /// @param stress     shape (Order, 6)
  void extrapolate(const Motion& motion, const Pack* increment, const Stencil& stencil,
                   Pack* stress) const noexcept;

  /// What the strains at some slots store, less those at others, or nullptr. @param slots shape (12
  /// num_nodes)
  void strain_energy(const Pack* slots, const Pack* less, Pack* energy) const noexcept;
  void find_momentum(const Pack* slots, const Pack* velocity,
                     PackMomentum& momentum) const noexcept;

  /// Where the entry (i, j) of a symmetric matrix of n rows is among those on and above the
  /// diagonal, by rows.
  static constexpr int entry(int n, int i, int j) {
    return i <= j ? i * (2 * n - 1 - i) / 2 + j : entry(n, j, i);
  }
  static constexpr int entries(int n) { return n * (n + 1) / 2; }

  /// Constants of the elements at a Gauss point.
  struct Point {
    std::array<double, num_nodes> N;
    Packs<num_nodes> dN;
    Packs<6> reference;
    Packs<entries(6)> stiffness;  ///< see entry
  };
  using Points = std::array<Point, Order>;
  /// Scalars between the slots x, d1, d2 of each two nodes a <= b: a symmetric matrix of three rows
  /// for each entry (a, b) of a symmetric matrix of num_nodes rows.
  using Mass = Packs<entries(3) * entries(num_nodes)>;

 private:
  Points points_;
  Mass mass_;
};

extern template class DirectorPack<1>;
extern template class DirectorPack<2>;
extern template class DirectorPack<3>;

static_assert(ComesInPacks<DirectorBeam<1>> && ComesInPacks<DirectorBeam<2>> &&
              ComesInPacks<DirectorBeam<3>>);

}  // namespace culm::beam
