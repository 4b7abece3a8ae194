#include "residual_check.hpp"

#include <array>
#include <utility>

namespace culm::solver {

ResidualCheck::ResidualCheck(Teuchos::RCP<const assembly::CrsMatrix> matrix,
                             const parallel::Comm& comm)
    : matrix_(std::move(matrix)), comm_(comm), first_columns_(first_columns(*matrix_)) {
  if (comm.size() == 1) return;
  ghosts_.emplace(assembly::rows_of(matrix_->getRowMap()), assembly::rows_of(matrix_->getColMap()));
}

double ResidualCheck::operator()(const assembly::Vector& b, const assembly::Vector& x) {
  return find(b, x, {});
}

double ResidualCheck::keep_rest(const assembly::Vector& b, const assembly::Vector& x) {
  if (!rest_) rest_.emplace(b.rows());
  return find(b, x, rest_->values());
}

double ResidualCheck::find(const assembly::Vector& b, const assembly::Vector& x,
                           std::span<double> rest) {
  const assembly::ColumnValues all =
      ghosts_ ? (*ghosts_)(x) : assembly::ColumnValues{x.values(), {}};
  const Residual mine = residual(*matrix_, first_columns_, all, b.values(), rest);
  std::array<double, 2> joint = {mine.largest, mine.size};
  comm_.max(joint);
  return Residual{joint[0], joint[1]}.relative();
}

}  // namespace culm::solver
