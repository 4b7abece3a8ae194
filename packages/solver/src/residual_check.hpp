/// The residual of solutions whose rows are spread over ranks.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>

#include <vector>

namespace culm::solver {

/// Of one matrix, whose values may change.
class ResidualCheck {
 public:
  ResidualCheck(Teuchos::RCP<const assembly::CrsMatrix> matrix, const parallel::Comm& comm);

  /// The relative residual of A x = b, see `Residual`. Collective, the same on all ranks.
  double operator()(const assembly::Vector& b, const assembly::Vector& x);
  /// b - A x of the last call.
  const assembly::Vector& rest() const { return rest_; }

 private:
  Teuchos::RCP<const assembly::CrsMatrix> matrix_;
  parallel::Comm comm_;
  std::vector<int> first_columns_;
  assembly::Vector columns_;  // values of all local columns
  assembly::Vector rest_;
};

}  // namespace culm::solver
