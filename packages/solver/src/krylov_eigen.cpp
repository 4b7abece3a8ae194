// GCC 12 takes the end of a vector for a second one when it inlines Spectra's complex matrices.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif

#include <culm/base/error.hpp>

#include "eigen_methods.hpp"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::solver {
namespace {

using ConstVectorMap = Eigen::Map<const Eigen::VectorXd>;
using VectorMap = Eigen::Map<Eigen::VectorXd>;

// For Spectra an error is small where it is so against eps^(2/3) = 3.7e-11, and a vector against
// eps, whatever the size of all values: at frequencies from 26 kHz on anything would do. So where
// the largest value is below 1 the operator is multiplied by a power of two, which rounds nothing,
// that brings it there. A few steps of the power method tell its size.
template <class Apply, class Square>
double factor_of(Eigen::Index size, const Apply& apply, const Square& square) {
  constexpr int steps = 4;
  Eigen::VectorXd x(size), y(size);
  for (Eigen::Index i = 0; i < size; ++i) x[i] = std::sin(static_cast<double>(i) + 1.0);
  double growth = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double before = square(x);
    apply(x, y);
    growth = std::sqrt(square(y) / before);
    if (!std::isfinite(growth) || growth == 0.0) return 1.0;
    x = y / growth;
  }
  return std::max(1.0, std::exp2(-std::floor(std::log2(growth))));
}

// Operators with the names that Spectra wants.
class SolveOp {
 public:
  using Scalar = double;
  SolveOp(const ShiftedPencil& op, const Eigen::MatrixXd& found) : op_(op), found_(found) {
    B_found_.resizeLike(found);
    for (Eigen::Index i = 0; i < found.cols(); ++i) {
      op.inverse.multiply(*op.pencil.B, found.col(i), B_found_.col(i));
    }
  }
  Eigen::Index rows() const { return op_.inverse.size(); }
  Eigen::Index cols() const { return op_.inverse.size(); }
  void set_shift(double) const {}  // it is factored
  void perform_op(const double* x, double* y) const {
    VectorMap result(y, rows());
    op_.inverse.solve(ConstVectorMap(x, rows()), result);
    if (found_.cols() > 0) result -= found_ * (B_found_.transpose() * result);
    result *= factor_;
  }

  double factor() const { return factor_; }
  void choose_factor() {
    Eigen::VectorXd Bx(rows());
    const auto product = [&](const Eigen::VectorXd& x) -> const Eigen::VectorXd& {
      op_.inverse.multiply(*op_.pencil.B, x, Bx);
      return Bx;
    };
    factor_ = factor_of(
        rows(),
        [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
          perform_op(product(x).data(), y.data());
        },
        [&](const Eigen::VectorXd& x) { return x.dot(product(x)); });
  }

 private:
  const ShiftedPencil& op_;
  const Eigen::MatrixXd& found_;
  Eigen::MatrixXd B_found_;
  double factor_ = 1.0;
};

class ProductOp {
 public:
  using Scalar = double;
  explicit ProductOp(const ShiftedPencil& op) : op_(op) {}
  Eigen::Index rows() const { return op_.inverse.size(); }
  Eigen::Index cols() const { return op_.inverse.size(); }
  void perform_op(const double* x, double* y) const {
    op_.inverse.multiply(*op_.pencil.B, ConstVectorMap(x, rows()), VectorMap(y, rows()));
  }

 private:
  const ShiftedPencil& op_;
};

class GeneralOp {
 public:
  using Scalar = double;
  explicit GeneralOp(const Operator& op) : op_(op) {
    factor_ = factor_of(
        rows(),
        [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { perform_op(x.data(), y.data()); },
        [](const Eigen::VectorXd& x) { return x.squaredNorm(); });
  }
  Eigen::Index rows() const { return op_.size; }
  Eigen::Index cols() const { return op_.size; }
  void perform_op(const double* x, double* y) const {
    VectorMap result(y, op_.size);
    op_.apply(ConstVectorMap(x, op_.size), result);
    result *= factor_;
  }
  double factor() const { return factor_; }

 private:
  const Operator& op_;
  double factor_ = 1.0;
};

template <class Solver>
int run(Solver& solver) {
  solver.init();
  return static_cast<int>(solver.compute(Spectra::SortRule::LargestMagn, most_restarts,
                                         krylov_tolerance, Spectra::SortRule::LargestMagn));
}

}  // namespace

std::string Convergence::note() const {
  if (tried < 2) return {};
  return fmt::format("eigenvalues that lie close together took a Krylov space of {} vectors",
                     space);
}

void throw_unconverged(const Convergence& convergence, int count) {
  throw NumericalError(
      fmt::format("The eigenproblem was not solved: {} of {} values converged, in Krylov spaces of "
                  "up to {} vectors.\n"
                  "Try: more or fewer modes, another shift, or 'Solver' = Dense.",
                  convergence.converged, count, convergence.space));
}

void throw_broken_down() {
  throw NumericalError(
      "The eigenproblem was not solved: the vectors found do not fulfil its equations.\n"
      "Likely cause: more modes are asked for than the model has, or nothing in it is elastic.\n"
      "Try: fewer modes, or 'Solver' = Dense.");
}

InvertedPairs solve_lanczos(const ShiftedPencil& op, int count, const Eigen::MatrixXd& found) {
  SolveOp solve(op, found);
  solve.choose_factor();
  ProductOp product(op);
  InvertedPairs pairs;
  pairs.convergence = widen(count, op.inverse.size(), [&](int space) {
    Spectra::SymGEigsShiftSolver<SolveOp, ProductOp, Spectra::GEigsMode::ShiftInvert> solver(
        solve, product, count, space, 0.0);  // values are 1 / nu
    const int converged = run(solver);
    if (converged < count) return converged;
    pairs.nu = solver.eigenvalues().cwiseInverse() / solve.factor();
    pairs.vectors = solver.eigenvectors();
    return converged;
  });
  return pairs;
}

GeneralPairs solve_arnoldi(const Operator& op, int count) {
  GeneralOp general(op);
  GeneralPairs pairs;
  pairs.convergence = widen(count, op.size, [&](int space) {
    Spectra::GenEigsSolver<GeneralOp> solver(general, count, space);
    const int converged = run(solver);
    if (converged < count) return converged;
    pairs.nu = solver.eigenvalues() / general.factor();
    pairs.vectors = solver.eigenvectors();
    return converged;
  });
  return pairs;
}

GeneralPairs solve_arnoldi_or_dense(const Operator& op, int count, std::string& method,
                                    std::string& notes) {
  GeneralPairs pairs = solve_arnoldi(op, count);
  if (pairs.nu.size() > 0) {
    add_note(pairs.convergence.note(), notes);
    return pairs;
  }
  if (op.size > largest_dense) throw_unconverged(pairs.convergence, count);
  add_note("eigenvalues did not converge in Krylov spaces, so whole matrices were reduced", notes);
  method = "Dense";
  return solve_dense(op);
}

}  // namespace culm::solver
