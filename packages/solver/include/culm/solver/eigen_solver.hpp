/// Eigenvalues near a shift, of large sparse pencils.
#pragma once

#include <culm/assembly/matrix.hpp>
#include <culm/parallel/comm.hpp>

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace culm::solver {

/// A x = lambda B x with matrices of one graph. A is symmetric and may be bordered by constraints,
/// [[K, H^T], [H, 0]]; B is symmetric positive semidefinite and zero in the rows and columns of
/// constraints, which therefore belong to infinite eigenvalues. @source formulation 5.4 (b)
struct SymmetricPencil {
  std::shared_ptr<const assembly::Matrix> A;
  std::shared_ptr<const assembly::Matrix> B;
};

/// Which eigenvalues, and how.
struct EigenSettings {
  std::string solver = "Automatic";         ///< one of eigen_solver_names()
  std::string linear_solver = "Automatic";  ///< for A - shift B, as choose_linear_solver
  int count = 10;
  double shift = 0.0;  ///< the eigenvalues next to it are found; must not be one of them
};

/// Finite eigenvalues with their vectors, rising; the same on all ranks.
struct EigenPairs {
  std::vector<double> values;
  Eigen::MatrixXd vectors;       ///< columns with x^T B x = 1; all unknowns in global order
  std::vector<double> rounding;  ///< what rounding of A alone may do to a value: eps |x|^T |A| |x|
  double worst_residual = 0.0;   ///< largest |A x - lambda B x| over the largest | |A| |x| |
  std::string solver;            ///< that did it
  std::string note;              ///< what had to be done beside the usual; empty if nothing
  bool are_all = false;          ///< there are no more than these
};

/// What decks may write, the default first.
const std::vector<std::string>& eigen_solver_names();
/// The same for solve_buckling.
const std::vector<std::string>& buckling_solver_names();

/// The eigenvalues next to the shift, by shift-invert; fewer if there are fewer finite ones.
/// `Dense` reduces whole matrices and needs time and memory for them; the others find values by a
/// Krylov space and then search once more beside what they found, because a space from few start
/// vectors may miss copies of multiple values: `Spectra` (Lanczos) with whole vectors, alike on all
/// ranks, `Anasazi` (block Krylov-Schur) with distributed ones. `Automatic` takes `Dense` for small
/// pencils, else `Spectra` on one rank and `Anasazi` on several. Vectors of multiple values are
/// turned so that they do not depend on the method. Where values do not converge, larger Krylov
/// spaces are tried, then `Dense` if the pencil is not too large, with a note. Fewer values than
/// asked for are all there are. Throws NumericalError if A - shift B is singular or nothing
/// converges. Collective.
EigenPairs solve_eigenproblem(const SymmetricPencil& pencil, const EigenSettings& settings,
                              const parallel::Comm& comm);

/// (K + mu D) x = 0: loads that grow until a structure has no stiffness left against x. Matrices of
/// one graph; both may be bordered by constraints. @source formulation 5.5
struct BucklingPencil {
  std::shared_ptr<const assembly::Matrix> K;
  std::shared_ptr<const assembly::Matrix> D;
  bool is_symmetric = true;  ///< then copies of multiple values are found, too
};

/// The values mu next to zero of both signs, by their size; vectors with |x^T K x| = 1. K must have
/// an inverse. Complex values are left out, with a note. Settings as in solve_eigenproblem, with
/// shift 0, but for `Anasazi`: K is no inner product about an unstable state, and D may be
/// unsymmetric.
EigenPairs solve_buckling(const BucklingPencil& pencil, const EigenSettings& settings,
                          const parallel::Comm& comm);

/// (lambda^2 M + lambda C + K) x = 0 with any real K and C, bordered as in SymmetricPencil.
struct QuadraticPencil {
  std::shared_ptr<const assembly::Matrix> K;
  std::shared_ptr<const assembly::Matrix> C;
  std::shared_ptr<const assembly::Matrix> M;
};

/// Finite eigenvalues with their vectors, by their size; of conjugate pairs the one above the real
/// axis. The same on all ranks.
struct ComplexPairs {
  std::vector<std::complex<double>> values;
  Eigen::MatrixXcd vectors;  ///< columns with x^H M x = 1, or |x^H C x| = 1 without mass
  /// What rounding may do to lambda^2: eps (|x|^T |K| |x| + shift^2 x^H M x).
  std::vector<double> rounding;
  double worst_residual = 0.0;  ///< largest residual over the largest | |K| |x| |
  std::string solver;
  std::string note;      ///< as in EigenPairs
  bool are_all = false;  ///< likewise
};

/// Whether a value of the quadratic problem is zero within what rounding may do to its square.
bool is_zero(std::complex<double> value, double rounding);

/// The eigenvalues next to the shift, a real number >= 0, by the linearised problem of twice the
/// size and Arnoldi's method; `Anasazi` means `Spectra` here. Free motions, double values at zero,
/// are there once. @source formulation 5.4
ComplexPairs solve_quadratic(const QuadraticPencil& pencil, const EigenSettings& settings,
                             const parallel::Comm& comm);

}  // namespace culm::solver
