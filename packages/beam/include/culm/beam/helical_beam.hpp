/// Two-node beam element that is exact for constant strain.
#pragma once

#include <culm/beam/helical_strain.hpp>
#include <culm/mechanics/element.hpp>

#include <array>

namespace culm::beam {

/// Beam element whose strains are those of the helix that joins its two nodes: the logarithm of
/// the relative rigid motion. Its forms are the seven quadratic invariants z of that motion (see
/// HelicalInvariants) minus their reference values; the strains e(z) are not quadratic, therefore
/// the step uses the discrete derivative of the stored energy, which keeps energy and momenta.
///
/// Slots of a node: x, d1, d2, d3. The relative rotation of the nodes must stay below
/// `max_rotation`.
/// @source formulation 1.3.5; cf. Sonneville, Cardona, Brüls (2014)
class HelicalBeam {
 public:
  static constexpr NodeKind node_kind = NodeKind::node12;
  static constexpr int num_nodes = 2;
  static constexpr int num_slots = 8;
  static constexpr int num_points = 1;
  static constexpr int num_mass_points = 2;
  static constexpr int num_strains = HelicalInvariants::size;
  static constexpr int num_resultants = 6;
  /// Its stress over a step does what changes the stored energy, eq. (1.12); see StressConserves.
  static constexpr bool stress_conserves = true;
  /// Largest relative rotation of the nodes [rad]; the strains are singular at pi.
  static constexpr double max_rotation = 3.0;

  using Strain = Vec<num_strains>;
  using Nodes = Slots<num_slots>;

  /// @param reference  stress-free nodes; orthonormal triads, relative rotation below max_rotation
  /// @param stiffness  section stiffness (1.9) at the middle, symmetric [N, N m, N m^2]
  /// @param mass       section mass (1.10) at the two Gauss points [kg/m, kg, kg m]
  HelicalBeam(const Nodes& reference, const Mat6& stiffness,
              const std::array<Mat3, num_mass_points>& mass);

  /// z - z_ref [-]
  void strain(int point, const Nodes& q, Strain& y) const noexcept;
  void gradient(int point, const Nodes& q, Gradient<num_slots, num_strains>& B) const noexcept;
  void add_curvature(int point, const Strain& S, SlotMatrix<num_slots>& A) const noexcept;
  /// Derivative of the stored energy at the new end (theta = 1), else the discrete derivative over
  /// the step, eq. (1.12). `inverted_element` beyond max_rotation, `law_out_of_range` if the triads
  /// are far from orthonormal.
  Verdict respond(int point, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<num_strains>& response) const noexcept;
  /// Not a number where respond() would not be `ok`.
  double energy(int point, const Strain& y) const noexcept;
  /// Consistent mass for linearly interpolated slots, eq. (1.10); the slots d3 carry none
  SlotMatrix<num_slots> mass() const noexcept;

  /// C e, components in the section triad [N, N m]
  Vec6 resultants(int point, const Strain& y) const noexcept;
  static constexpr std::array<const char*, num_resultants> resultant_names() {
    return {"N1", "N2", "N3", "M1", "M2", "M3"};
  }

  /// (Γ1, Γ2, Γ3, K1, K2, K3) minus reference [-, 1/m]
  Vec6 section_strain(const Strain& y) const noexcept;
  /// The same before subtraction, in the reference
  const Vec6& reference_strain() const noexcept { return strain_reference_; }
  /// Length of the reference helix [m]
  double length() const noexcept { return length_; }

 private:
  Verdict check(const Vec<num_strains>& z) const noexcept;
  Strain step_stress(const Strain& z0, const Strain& z1, const Vec6& w) const noexcept;

  Vec<num_strains> z_reference_;
  Vec6 strain_reference_;
  double length_;
  Mat6 stiffness_;                          // C
  std::array<Mat3, num_mass_points> mass_;  // w J m3
};

static_assert(Element<HelicalBeam> && HasResultants<HelicalBeam>);

}  // namespace culm::beam
