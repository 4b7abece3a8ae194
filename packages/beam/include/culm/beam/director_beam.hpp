/// Geometrically exact beam by interpolation of positions and directors.
#pragma once

#include <culm/mechanics/element.hpp>
#include <culm/model/turn_source.hpp>

#include <algorithm>
#include <array>

namespace culm::beam {

template <int Order>
class DirectorPack;

/// Beam element with `Order + 1` nodes. Positions and directors are interpolated by Lagrange
/// polynomials and the strains taken at `Order` Gauss points, which avoids shear and membrane
/// locking. Strains are objective although interpolated directors are not orthonormal.
///
/// Nodes follow the axis; slots of a node: x, d1, d2, d3, where d3 points along the axis.
/// @source formulation 1.3.1, 1.3.3; Romero, Armero (2002), Betsch, Steinmann (2002)
template <int Order>
class DirectorBeam {
 public:
  static constexpr NodeKind node_kind = NodeKind::node12;
  static constexpr int num_nodes = Order + 1;
  static constexpr int num_slots = num_nodes * slots_of(node_kind);
  static constexpr int num_points = Order;
  static constexpr int num_mass_points = Order + 1;
  static constexpr int num_strains = 6;
  static constexpr int num_resultants = 6;
  static constexpr model::TurnKind turn_kind{Order, false};

  using Strain = Vec<num_strains>;
  using Nodes = Slots<num_slots>;
  using Pack = DirectorPack<Order>;

  /// @param reference  stress-free nodes; orthonormal triads
  /// @param stiffness  section stiffness (1.9) at the Gauss points, symmetric [N, N m, N m^2]
  /// @param mass       section mass (1.10) at the num_mass_points Gauss points [kg/m, kg, kg m]
  DirectorBeam(const Nodes& reference, const std::array<Mat6, num_points>& stiffness,
               const std::array<Mat3, num_mass_points>& mass);

  /// (Γ1, Γ2, Γ3, K1, K2, K3) minus reference, eq. (1.4) [-, 1/m]
  void strain(int point, const Nodes& q, Strain& e) const noexcept;
  /// Eq. (1.5)
  void gradient(int point, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept;
  /// Eq. (1.6)
  void add_curvature(int point, const Strain& S, SlotMatrix<num_slots>& A) const noexcept;
  /// S = w C e_alg, eq. (1.7); never fails
  Verdict respond(int point, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<num_strains>& response) const noexcept;
  /// w C of a point
  RowMat<6, 6> stiffness(int point) const noexcept {
    return at(point).length * at(point).stiffness;
  }
  /// C of a point, that of the section
  const RowMat<6, 6>& section_stiffness(int point) const noexcept { return at(point).stiffness; }
  double energy(int point, const Strain& e) const noexcept;
  /// Consistent mass, eq. (1.10); the slots d3 carry none
  SlotMatrix<num_slots> mass() const noexcept;

  /// C e, components in the section triad [N, N m]
  Vec6 resultants(int point, const Strain& e) const noexcept;
  static constexpr std::array<const char*, num_resultants> resultant_names() {
    return {"N1", "N2", "N3", "M1", "M2", "M3"};
  }

  /// Cosine of the largest turn between neighbouring nodes. @see HasTurn
  template <class SlotsAt>
  static double least_cosine(const SlotsAt& at) noexcept {
    double least = 1.0;
    for (int a = 0; a < Order; ++a) {
      least = std::min(least, model::cosine_between(at(a), at(a + 1)));
    }
    return least;
  }

  /// Strain of the reference before subtraction: (d_i . x', K_i) [-, 1/m]
  const Strain& reference_strain(int point) const noexcept { return at(point).reference; }
  /// Length of the reference axis that a Gauss point stands for, w_g J [m]
  double length(int point) const noexcept { return at(point).length; }
  /// Mass of the section at one of the num_mass_points, the length that it stands for [m], and the
  /// shape functions there
  const Mat3& section_mass(int point) const noexcept { return mass_at(point).mass; }
  double mass_length(int point) const noexcept { return mass_at(point).length; }
  const Vec<num_nodes>& mass_shape(int point) const noexcept { return mass_at(point).N; }
  /// Shape functions at a Gauss point, shape (num_nodes)
  const Vec<num_nodes>& shape(int point) const noexcept { return at(point).N; }
  /// Their derivatives by arc length [1/m]
  const Vec<num_nodes>& shape_derivative(int point) const noexcept { return at(point).dN; }

 private:
  struct Point {
    Vec<num_nodes> N;   // shape functions
    Vec<num_nodes> dN;  // their derivatives by arc length, N' [1/m]
    double length;      // w_g J [m]
    Strain reference;
    RowMat<6, 6> stiffness;
  };
  struct MassPoint {
    Vec<num_nodes> N;
    double length;  // w_g J [m]
    Mat3 mass;
  };

  const Point& at(int point) const noexcept { return points_[static_cast<std::size_t>(point)]; }
  const MassPoint& mass_at(int point) const noexcept {
    return mass_points_[static_cast<std::size_t>(point)];
  }
  static Strain absolute_strain(const Point& point, const Nodes& q) noexcept;

  std::array<Point, num_points> points_;
  std::array<MassPoint, num_mass_points> mass_points_;
};

extern template class DirectorBeam<1>;
extern template class DirectorBeam<2>;
extern template class DirectorBeam<3>;

static_assert(Element<DirectorBeam<1>> && Element<DirectorBeam<2>> && Element<DirectorBeam<3>>);
static_assert(HasStiffness<DirectorBeam<1>> && HasResultants<DirectorBeam<1>> &&
              model::HasTurn<DirectorBeam<1>>);

}  // namespace culm::beam
