#include "shift_invert.hpp"

#include <culm/base/error.hpp>

#include "one_factorisation.hpp"

#include <cmath>
#include <vector>

namespace culm::solver {

using assembly::Matrix;

namespace {

[[noreturn]] void refuse() {
  throw NumericalError(
      "The eigenproblem cannot be solved: its matrix is singular at the shift.\n"
      "Likely cause: a motion that has neither stiffness nor mass, or a shift that is an "
      "eigenvalue; in\nbuckling, a structure that can move freely or has lost its stiffness.\n"
      "Try: another shift; density or rotary inertia for every structure; supports.");
}

}  // namespace

std::shared_ptr<Matrix> combine(
    const std::vector<std::pair<double, std::shared_ptr<const Matrix>>>& terms) {
  const auto sum = std::make_shared<Matrix>(*terms.front().second);
  const auto values = sum->values();
  for (double& value : values) value *= terms.front().first;
  for (std::size_t i = 1; i < terms.size(); ++i) {
    const auto more = terms[i].second->values();
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += terms[i].first * more[k];
  }
  return sum;
}

ShiftInvert::ShiftInvert(const std::shared_ptr<Matrix>& factored, const std::string& linear_solver,
                         const parallel::Comm& comm)
    : comm_(comm),
      whole_(factored->rows(), comm),
      factored_(factored),
      linear_(choose_for_one_factorisation(linear_solver, factored_, comm).solver),
      in_(factored->rows()),
      out_(factored->rows()) {
  if (!linear_->factor()) refuse();
}

void ShiftInvert::multiply(const Matrix& matrix, const ConstColumn& x, Column y) const {
  whole_.take(x, in_.values());
  matrix.multiply(in_, out_);
  whole_.join(out_.values(), y);
}

void ShiftInvert::solve(const Vector& x, Vector& y) {
  if (!linear_->solve(x, y).is_sound()) refuse();
}

void ShiftInvert::solve(const ConstColumn& x, Column y) {
  whole_.take(x, in_.values());
  solve(in_, out_);
  whole_.join(out_.values(), y);
}

Eigen::VectorXd ShiftInvert::absolute(const Matrix& matrix, const Eigen::VectorXd& x) const {
  out_.fill(0.0);
  const auto out = out_.values();
  matrix.each_entry([&](std::size_t row, long long column, double value) {
    out[row] += std::abs(value * x[column]);
  });
  Eigen::VectorXd all(size());
  whole_.join(out, all);
  return all;
}

double ShiftInvert::quotient(const Matrix& matrix, const Eigen::VectorXd& x) const {
  std::vector<long double> products(whole_.rows().size(), 0.0L);
  matrix.each_entry([&](std::size_t row, long long column, double value) {
    products[row] += static_cast<long double>(value) * x[column];
  });
  double total = 0.0;
  for (std::size_t row = 0; row < products.size(); ++row) {
    total += x[whole_.rows()[row]] * static_cast<double>(products[row]);
  }
  return comm_.sum(total);
}

Eigen::MatrixXd ShiftInvert::dense(const Matrix& matrix) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size(), size());
  matrix.each_entry([&](std::size_t row, long long column, double value) {
    all(whole_.rows()[row], column) = value;
  });
  comm_.sum({all.data(), static_cast<std::size_t>(all.size())});
  return all;
}

}  // namespace culm::solver
