/// The strain components of the four-node shell at a point, as linear functions of its forms.
#pragma once

#include <culm/material/layup.hpp>
#include <culm/shell/shell_forms.hpp>

#include <string>
#include <vector>

namespace culm::shell {

/// Enhanced strains: how many parameters; 0 for none. @source formulation 1.4, (1.17)
struct Enhancement {
  int membrane = 4;   ///< 0; 4: linear; 7: with the products ξη as well
  int thickness = 4;  ///< 0; 1: linear through the thickness; 4: and bilinear in the plane

  static constexpr int most = 11;
  int size() const { return membrane + thickness; }
  bool operator==(const Enhancement&) const = default;
};

/// Values of the enhanced parameters; as many as `Enhancement::size`.
using EnhancedParameters = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Enhancement::most, 1>;

/// What may be chosen about the element. The defaults are free of locking; without assumed strains
/// the element locks, which is good for showing just that.
struct ShellOptions {
  bool assumed_shear = true;      ///< transverse shear from the edge midpoints (1.15)
  bool assumed_thickness = true;  ///< thickness strain from the corners (1.16)
  Enhancement enhancement = {};
  /// Its projection on the shell is the axis 1 of materials and resultants; zero: the first
  /// parametric line (ξ).
  Vec3 reference_axis = Vec3::Zero();
};

/// A four-node shell in its reference: base vectors, volumes, local axes, strains.
class ShellGeometry {
 public:
  using Nodes = ShellForms::Nodes;
  /// Voigt order 11, 22, 33, 23, 13, 12 with engineering shears, one column per form
  using StrainMap = RowMat<6, ShellForms::num_strains>;
  using EnhancedModes = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, Enhancement::most>;

  /// What a quadrature point wants to know. Components along A1, A2, A3 of the point: A3 normal to
  /// the surface ζ = const, A1 the reference axis projected on it.
  struct Point {
    double J;                ///< dV = J dξ dη dζ [m^2]
    StrainMap strain;        ///< E = strain y
    EnhancedModes enhanced;  ///< E += enhanced α
  };

  /// Of the wall of an element, with its hourglass factors.
  /// @pre shell_mistakes(...) is empty
  ShellGeometry(const Nodes& reference, const material::Layup& layup, const ShellOptions& options);
  /// Of the space that an element fills: volumes and axes; strains are those of a wall with
  /// hourglass factors 0.
  ShellGeometry(const Nodes& reference, double thickness, const ShellOptions& options);

  /// @param angle  turns A1, A2 about A3 [rad]
  Point at(double xi, double eta, double zeta, double angle = 0.0) const;
  /// det [G1 G2 G3] [m^2]
  double jacobian(double xi, double eta, double zeta) const;
  /// A1, A2, A3 as columns
  Mat3 axes(double xi, double eta, double zeta, double angle = 0.0) const;
  const ShellOptions& options() const { return options_; }
  /// c1, c2, see hourglass_factors
  const Vec<2>& hourglass() const { return hourglass_; }

 private:
  Mat3 base_vectors(double xi, double eta, double zeta) const;
  StrainMap covariant_strains(double xi, double eta, double zeta) const;
  EnhancedModes covariant_modes(double xi, double eta, double zeta) const;

  ShellForms::Modes reference_;
  double thickness_;
  ShellOptions options_;
  double J_centre_;
  Mat3 contravariant_centre_;  // G^1, G^2, G^3 as rows
  Vec<2> hourglass_ = Vec<2>::Zero();
};

/// Bilinear shape functions of the nodes at a point.
Vec<4> shape_functions(double xi, double eta);

/// What makes an element impossible, one sentence each; empty if nothing does: a corner whose
/// volume is not positive, within the thickness; a reference axis along the normal.
std::vector<std::string> shell_mistakes(const ShellForms::Nodes& reference, double thickness,
                                        const ShellOptions& options = {});

}  // namespace culm::shell
