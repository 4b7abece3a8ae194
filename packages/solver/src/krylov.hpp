/// Conjugate gradients and GMRES of Belos, preconditioned by multigrid.
#pragma once

#include "multigrid.hpp"

namespace culm::solver {

/// How an iteration is to end.
struct KrylovGoal {
  double reduction = 1e-8;  ///< of |b - A x| over |b|
  int most_iterations = 100;
};

/// How it ended, by its own recursion; the caller looks at b - A x.
struct KrylovEnd {
  bool converged = false;
  int iterations = 0;
};

/// For symmetric positive definite matrices; ends without convergence where a direction has no
/// positive energy. Starts from x. Collective.
KrylovEnd conjugate_gradients(Multigrid& multigrid, const assembly::Vector& b, assembly::Vector& x,
                              const KrylovGoal& goal);
/// For any matrix; keeps a vector for each iteration up to a restart. Starts from x. Collective.
KrylovEnd minimise_residual(Multigrid& multigrid, const assembly::Vector& b, assembly::Vector& x,
                            const KrylovGoal& goal);

}  // namespace culm::solver
