#include "shift_invert.hpp"

#include <culm/base/error.hpp>

#include "one_factorisation.hpp"

#include <cmath>

namespace culm::solver {

using assembly::CrsMatrix;

namespace {

[[noreturn]] void refuse() {
  throw NumericalError(
      "The eigenproblem cannot be solved: its matrix is singular at the shift.\n"
      "Likely cause: a motion that has neither stiffness nor mass, or a shift that is an "
      "eigenvalue; in\nbuckling, a structure that can move freely or has lost its stiffness.\n"
      "Try: another shift; density or rotary inertia for every structure; supports.");
}

}  // namespace

Teuchos::RCP<CrsMatrix> combine(
    const std::vector<std::pair<double, Teuchos::RCP<const CrsMatrix>>>& terms) {
  const auto sum = Teuchos::rcp(new CrsMatrix(*terms.front().second, Teuchos::Copy));
  const auto values = sum->getLocalMatrixHost().values;
  for (std::size_t k = 0; k < values.extent(0); ++k) values(k) *= terms.front().first;
  for (std::size_t i = 1; i < terms.size(); ++i) {
    const auto more = terms[i].second->getLocalMatrixHost().values;
    for (std::size_t k = 0; k < values.extent(0); ++k) values(k) += terms[i].first * more(k);
  }
  return sum;
}

ShiftInvert::ShiftInvert(const Teuchos::RCP<CrsMatrix>& factored, const std::string& linear_solver,
                         const parallel::Comm& comm)
    : comm_(comm),
      whole_(*factored->getRowMap(), comm),
      factored_(factored),
      linear_(choose_for_one_factorisation(linear_solver, factored_, comm).solver),
      in_(factored->getRowMap()),
      out_(factored->getRowMap()) {
  if (!linear_->factor()) refuse();
}

void ShiftInvert::multiply(const CrsMatrix& matrix, const ConstColumn& x, Column y) const {
  whole_.take(x, in_);
  matrix.apply(in_, out_);
  whole_.join(out_, y);
}

void ShiftInvert::solve(const Vector& x, Vector& y) {
  if (!linear_->solve(x, y).is_sound()) refuse();
}

void ShiftInvert::solve(const ConstColumn& x, Column y) {
  whole_.take(x, in_);
  solve(in_, out_);
  whole_.join(out_, y);
}

Eigen::VectorXd ShiftInvert::absolute(const CrsMatrix& matrix, const Eigen::VectorXd& x) const {
  const auto local = matrix.getLocalMatrixHost();
  const auto& columns = *matrix.getColMap();
  const auto out = assembly::values_of(out_);
  for (std::size_t row = 0; row < out.size(); ++row) {
    double sum = 0.0;
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      sum += std::abs(local.values(k) * x[columns.getGlobalElement(local.graph.entries(k))]);
    }
    out[row] = sum;
  }
  Eigen::VectorXd all(size());
  whole_.join(out_, all);
  return all;
}

double ShiftInvert::quotient(const CrsMatrix& matrix, const Eigen::VectorXd& x) const {
  const auto local = matrix.getLocalMatrixHost();
  const auto& columns = *matrix.getColMap();
  double total = 0.0;
  for (std::size_t row = 0; row < whole_.rows().size(); ++row) {
    long double sum = 0.0;
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      sum += static_cast<long double>(local.values(k)) *
             x[columns.getGlobalElement(local.graph.entries(k))];
    }
    total += x[whole_.rows()[row]] * static_cast<double>(sum);
  }
  return comm_.sum(total);
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
