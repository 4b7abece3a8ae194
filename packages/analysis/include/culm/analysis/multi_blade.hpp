/// Coordinates in which a turning rotor of equal blades has constant coefficients.
#pragma once

#include <culm/math/types.hpp>

#include <Eigen/SparseCore>

#include <vector>

namespace culm::analysis {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Unknowns of a rotor, which come as vectors: three in a row with the number of the first.
struct RotorUnknowns {
  /// Changes of the three directors of a node, which are not the same at each azimuth even where
  /// the node turns by the same small angle: its directors have gone on.
  struct Triad {
    int first = 0;                      ///< unknown of nine in a row
    Mat3 directors = Mat3::Identity();  ///< in the state, as columns
  };
  Vec3 axis = Vec3::UnitX();             ///< unit vector of the rotation
  std::vector<int> hub;                  ///< vectors of what turns and is no blade
  std::vector<Triad> triads;             ///< the same of its directors
  std::vector<double> azimuth;           ///< of each blade [rad], multiples of 2 pi / N
  std::vector<std::vector<int>> blades;  ///< vectors of each blade; the same number for all
};

/// The unknowns y of a model, those of a rotor as seen in the frame that turns with it, from
/// multi-blade coordinates z at the azimuth psi of the rotor: y = L(psi) z. Vectors of the hub are
/// those of the frame at rest, y = R(psi)^T z; triads W = R^T Z G with G = D^T R D. Blade k has, in
/// axes that turn with it,
///   u_k = (z_0 + sqrt(2) sum_m (z_mc cos m psi_k + z_ms sin m psi_k) [+ (-1)^k z_d]) / sqrt(N),
/// m = 1 … (N - 1) / 2, psi_k = psi + azimuth_k; z_d for even N only. Everything else stays. At psi
/// = 0 L is orthogonal. @source Coleman and Feingold, NACA TR 1351; Bir, AIAA 2008-1300
class MultiBlade {
 public:
  /// @param size number of all unknowns
  MultiBlade(int size, const RotorUnknowns& rotor);

  const SparseMatrix& L() const { return L_; }            ///< at psi = 0
  const SparseMatrix& first() const { return first_; }    ///< dL/dpsi there
  const SparseMatrix& second() const { return second_; }  ///< d2L/dpsi2 there
  /// The rotor turned by 2 pi / N, each blade in the place of the next, as a map of unknowns; of a
  /// rotor without blades by a third of a turn. Zero for what does not turn.
  const SparseMatrix& symmetry() const { return symmetry_; }

 private:
  SparseMatrix L_, first_, second_, symmetry_;
};

/// How much of a motion is which motion of blades: squares of norms in the metric of a mass.
struct WhirlShares {
  double collective = 0.0;  ///< all blades alike
  double backward = 0.0;    ///< a pattern that turns against the rotor
  double forward = 0.0;     ///< a pattern that turns with it
};

/// Of the motion z exp(i omega t), omega > 0, in multi-blade coordinates. The rest up to z^H M z
/// are alternating blades, the hub and what does not turn.
WhirlShares whirl_shares(const RotorUnknowns& rotor, const SparseMatrix& mass,
                         const Eigen::VectorXcd& z);

}  // namespace culm::analysis
