#include "shift_invert.hpp"

#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <cmath>

namespace culm::solver {

using assembly::CrsMatrix;

namespace {

constexpr double useless = 1e-8;  // residual of a solution, as LinearSolver measures it

Teuchos::RCP<CrsMatrix> combine(const SymmetricPencil& pencil, double shift) {
  const auto sum = Teuchos::rcp(new CrsMatrix(*pencil.A, Teuchos::Copy));
  const auto values = sum->getLocalMatrixHost().values;
  const auto b = pencil.B->getLocalMatrixHost().values;
  for (std::size_t k = 0; k < values.extent(0); ++k) values(k) -= shift * b(k);
  return sum;
}

[[noreturn]] void refuse(double shift) {
  throw NumericalError(
      fmt::format("The eigenproblem cannot be solved: the stiffness, shifted by {:.6g} times the "
                  "mass, is singular.\nLikely cause: a motion that has neither stiffness nor mass, "
                  "or a shift that is an eigenvalue.\nTry: another shift; density, mass or rotary "
                  "inertia for every structure.",
                  shift));
}

}  // namespace

ShiftInvert::ShiftInvert(const SymmetricPencil& pencil, const EigenSettings& settings,
                         const parallel::Comm& comm)
    : pencil_(pencil),
      comm_(comm),
      shift_(settings.shift),
      whole_(*pencil.A->getRowMap(), comm),
      shifted_(combine(pencil, settings.shift)),
      linear_(choose_linear_solver(settings.linear_solver, shifted_, comm).solver),
      in_(pencil.A->getRowMap()),
      out_(pencil.A->getRowMap()) {
  if (!linear_->factor()) refuse(shift_);
}

void ShiftInvert::multiply(const CrsMatrix& matrix, const ConstColumn& x, Column y) const {
  whole_.take(x, in_);
  matrix.apply(in_, out_);
  whole_.join(out_, y);
}

void ShiftInvert::solve(const ConstColumn& x, Column y) {
  whole_.take(x, in_);
  const double residual = linear_->solve(in_, out_);
  if (!(residual <= useless)) refuse(shift_);
  whole_.join(out_, y);
}

double ShiftInvert::size_of_A(const ConstColumn& x) const {
  const auto matrix = pencil_.A->getLocalMatrixHost();
  const auto& columns = *pencil_.A->getColMap();
  double size = 0.0;
  for (std::size_t row = 0; row < whole_.rows().size(); ++row) {
    double sum = 0.0;
    for (auto k = matrix.graph.row_map(row); k < matrix.graph.row_map(row + 1); ++k) {
      const auto column = columns.getGlobalElement(matrix.graph.entries(k));
      sum += std::abs(matrix.values(k) * x[column]);
    }
    size += std::abs(x[whole_.rows()[row]]) * sum;
  }
  return comm_.sum(size);
}

Eigen::MatrixXd ShiftInvert::dense(const CrsMatrix& matrix) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size(), size());
  const auto local = matrix.getLocalMatrixHost();
  for (std::size_t row = 0; row < whole_.rows().size(); ++row) {
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      all(whole_.rows()[row], matrix.getColMap()->getGlobalElement(local.graph.entries(k))) =
          local.values(k);
    }
  }
  comm_.sum({all.data(), static_cast<std::size_t>(all.size())});
  return all;
}

}  // namespace culm::solver
