/// Director beams side by side.
#pragma once

#include <culm/beam/director_beam.hpp>
#include <culm/math/fetch.hpp>
#include <culm/mechanics/pack.hpp>

#include <array>
#include <memory>

namespace culm::beam {

/// Elements of one order in a pack. Forces and tangents are those that ElementBatch makes of the
/// strains, their gradients and curvatures, in closed form. @source formulation 1.3.1, 5.2
template <int Order>
class DirectorPack {
 public:
  static constexpr int num_nodes = Order + 1;
  using Motion = PackMotion<num_nodes>;
  using Sum = PackSum<num_nodes>;

  /// @param before  another pack; where sections are the same, this one reads them there
  DirectorPack(const std::array<const DirectorBeam<Order>*, pack_lanes>& elements,
               const DirectorPack* before);

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
  /// @param velocity  of the slots, shape (12 num_nodes)
  void kinetic_energy(const Pack* velocity, Pack* energy) const noexcept;
  void find_momentum(const Pack* slots, const Pack* velocity,
                     PackMomentum& momentum) const noexcept;

  /// Asks the memory for what is not read of the pack itself, unless the one before read it, too.
  [[gnu::always_inline]] void fetch_shared(const DirectorPack& before) const {
    if (sections_ != before.sections_) fetch(sections_.get(), sizeof(Sections));
  }

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
    Pack length;
  };
  /// Of the elements themselves.
  struct Geometry {
    std::array<Point, Order> points;
    Packs<num_nodes> mass_lengths;  ///< of the points at which mass is integrated
    /// Products of the shape functions there, of each two nodes a <= b.
    std::array<std::array<double, entries(num_nodes)>, num_nodes> NN;
  };
  /// Of their sections, see entry: those of a uniform beam are the same for all of its packs.
  struct Sections {
    std::array<Packs<entries(6)>, Order> stiffness;
    std::array<Packs<entries(3)>, num_nodes> mass;
  };
  /// Scalars between the slots x, d1, d2 of each two nodes a <= b: a symmetric matrix of three rows
  /// for each entry (a, b) of a symmetric matrix of num_nodes rows.
  using Mass = Packs<entries(3) * entries(num_nodes)>;

 private:
  Geometry geometry_;
  std::shared_ptr<const Sections> sections_;
};

extern template class DirectorPack<1>;
extern template class DirectorPack<2>;
extern template class DirectorPack<3>;

static_assert(ComesInPacks<DirectorBeam<1>> && ComesInPacks<DirectorBeam<2>> &&
              ComesInPacks<DirectorBeam<3>>);

}  // namespace culm::beam
