#include <culm/solver/linear_solver.hpp>

#include "rooted_matrix.hpp"

#include <Amesos2.hpp>

#include <algorithm>
#include <cmath>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::values_of;
using MultiVector = Tpetra::MultiVector<>;
using Klu2 = Amesos2::Solver<CrsMatrix, MultiVector>;

double largest(std::span<const double> values) {
  double result = 0.0;
  for (double value : values) result = std::max(result, std::abs(value));
  return result;
}

double largest_entry(const CrsMatrix& A) {
  const auto values = A.getLocalMatrixHost().values;
  return largest({values.data(), values.extent(0)});
}

// |b - A x| over the largest sum of the terms of a row, in the maximum norm. A row may hold nothing
// but rounding, so rows are not judged one by one.
double relative_residual(const CrsMatrix& A, std::span<const double> x, std::span<const double> b) {
  const auto matrix = A.getLocalMatrixHost();
  double residual = 0.0;
  double size = 0.0;
  for (std::size_t row = 0; row < b.size(); ++row) {
    double r = b[row];
    double terms = std::abs(b[row]);
    for (auto k = matrix.graph.row_map(row); k < matrix.graph.row_map(row + 1); ++k) {
      const double term = matrix.values(k) * x[static_cast<std::size_t>(matrix.graph.entries(k))];
      r -= term;
      terms += std::abs(term);
    }
    if (!std::isfinite(r)) return std::numeric_limits<double>::infinity();
    residual = std::max(residual, std::abs(r));
    size = std::max(size, terms);
  }
  return size > 0.0 ? residual / size : 0.0;
}

class RootedKlu2 final : public LinearSolver {
 public:
  RootedKlu2(const Teuchos::RCP<const CrsMatrix>& matrix, const parallel::Comm& comm)
      : comm_(comm), rooted_(matrix, comm) {
    if (!comm_.is_root()) return;
    klu_ = Amesos2::create<CrsMatrix, MultiVector>("KLU2", rooted_.matrix());
  }

  std::string name() const override { return "KLU2"; }

  bool factor() override {
    rooted_.gather_values();
    bool sound = true;
    if (comm_.is_root()) {
      try {
        if (!analysed_) klu_->symbolicFactorization();
        analysed_ = true;
        klu_->numericFactorization();
      } catch (const std::exception&) {  // how Amesos2 reports a zero pivot
        sound = false;
      }
    }
    return comm_.max(sound ? 0 : 1) == 0;
  }

  double solve(const Vector& b, Vector& x) override {
    rooted_.gather_rhs(b);
    double residual = 0.0;
    if (comm_.is_root()) {
      klu_->solve(&rooted_.solution(), &rooted_.rhs());
      residual = relative_residual(*rooted_.matrix(), values_of(rooted_.solution()),
                                   values_of(rooted_.rhs()));
    }
    rooted_.scatter_solution(x);
    return comm_.max(residual);
  }

  double weakest_direction(Vector& v) override {
    rooted_.gather_values();
    double ratio = 0.0;
    if (comm_.is_root()) ratio = inverse_iteration();
    rooted_.scatter_solution(v);
    return comm_.max(ratio);
  }

 private:
  // Factors A + shift 1 and iterates; the shift makes an exactly singular matrix invertible and is
  // far below every eigenvalue of a sound one.
  double inverse_iteration() {
    const Teuchos::RCP<CrsMatrix>& A = rooted_.matrix();
    const double size = largest_entry(*A);
    const auto shifted = Teuchos::rcp(new CrsMatrix(*A, Teuchos::Copy));
    const auto matrix = shifted->getLocalMatrixHost();
    for (int row = 0; row < matrix.numRows(); ++row) {
      const auto at = static_cast<std::size_t>(row);
      for (auto k = matrix.graph.row_map(at); k < matrix.graph.row_map(at + 1); ++k) {
        if (matrix.graph.entries(k) == row) matrix.values(k) += 1e-13 * size;
      }
    }
    const auto klu = Amesos2::create<CrsMatrix, MultiVector>("KLU2", shifted);
    Vector& v = rooted_.solution();
    Vector& b = rooted_.rhs();
    // a start vector without symmetry, the same in every run
    double seed = 0.5;
    for (double& entry : values_of(b)) {
      seed = std::fmod(997.0 * seed + 0.1234567, 1.0);
      entry = seed - 0.5;
    }
    try {
      klu->symbolicFactorization().numericFactorization();
    } catch (const std::exception&) {  // how Amesos2 reports a zero pivot
      v.putScalar(0.0);
      return 0.0;
    }
    for (int i = 0; i < 4; ++i) {
      klu->solve(&v, &b);
      v.scale(1.0 / std::max(largest(values_of(v)), 1e-300));
      b.assign(v);
    }
    A->apply(v, b);
    return largest(values_of(b)) / std::max(size, 1e-300);
  }

  parallel::Comm comm_;
  RootedMatrix rooted_;
  Teuchos::RCP<Klu2> klu_;
  bool analysed_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_rooted_klu2(const Teuchos::RCP<const CrsMatrix>& matrix,
                                               const parallel::Comm& comm) {
  return std::make_unique<RootedKlu2>(matrix, comm);
}

}  // namespace culm::solver
