/// The residual of solutions whose rows are spread over ranks.
#pragma once

#include <culm/assembly/ghost_import.hpp>
#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>

#include "matrix_checks.hpp"

#include <optional>
#include <span>
#include <vector>

namespace culm::solver {

/// Of one matrix, whose values may change.
class ResidualCheck {
 public:
  ResidualCheck(Teuchos::RCP<const assembly::CrsMatrix> matrix, const parallel::Comm& comm);

  /// The relative residual of A x = b, see `Residual`. Collective, the same on all ranks.
  double operator()(const assembly::Vector& b, const assembly::Vector& x);
  /// The same, and leaves b - A x in rest().
  double keep_rest(const assembly::Vector& b, const assembly::Vector& x);
  /// @pre keep_rest was called
  const assembly::Vector& rest() const { return *rest_; }

 private:
  double find(const assembly::Vector& b, const assembly::Vector& x, std::span<double> rest);

  Teuchos::RCP<const assembly::CrsMatrix> matrix_;
  parallel::Comm comm_;
  std::vector<int> first_columns_;
  std::optional<assembly::GhostImport> ghosts_;  // if there are several ranks
  std::optional<assembly::Vector> rest_;         // most solutions are never refined
};

}  // namespace culm::solver
