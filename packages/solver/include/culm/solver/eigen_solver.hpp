/// Eigenvalues near a shift, of large sparse pencils.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace culm::solver {

/// A x = lambda B x with matrices of one graph. A is symmetric and may be bordered by constraints,
/// [[K, H^T], [H, 0]]; B is symmetric positive semidefinite and zero in the rows and columns of
/// constraints, which therefore belong to infinite eigenvalues. @source formulation 5.4 (b)
struct SymmetricPencil {
  Teuchos::RCP<const assembly::CrsMatrix> A;
  Teuchos::RCP<const assembly::CrsMatrix> B;
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
  double worst_residual = 0.0;   ///< |A x - lambda B x| over the sum of the sizes of the two terms
  std::string solver;            ///< that did it
};

/// What decks may write, the default first.
const std::vector<std::string>& eigen_solver_names();

/// The eigenvalues next to the shift, by shift-invert; fewer if there are fewer finite ones.
/// `Dense` reduces whole matrices and needs time and memory for them; the others find values by a
/// Krylov space and then search once more beside what they found, because a space from few start
/// vectors may miss copies of multiple values. Throws NumericalError if A - shift B is singular or
/// the iteration does not converge. Collective.
EigenPairs solve_eigenproblem(const SymmetricPencil& pencil, const EigenSettings& settings,
                              const parallel::Comm& comm);

/// Largest |A_ij - A_ji| over the root of the product of the largest entries of rows i and j: what
/// is left of symmetry. Collective.
double asymmetry(const Teuchos::RCP<const assembly::CrsMatrix>& matrix, const parallel::Comm& comm);

}  // namespace culm::solver
