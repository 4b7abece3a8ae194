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

namespace culm::solver {
namespace {

constexpr int most_restarts = 300;
constexpr double tolerance = 1e-11;

using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using Map = Eigen::Map<Eigen::VectorXd>;

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
    Map result(y, rows());
    op_.inverse.solve(ConstMap(x, rows()), result);
    if (found_.cols() > 0) result -= found_ * (B_found_.transpose() * result);
  }

 private:
  const ShiftedPencil& op_;
  const Eigen::MatrixXd& found_;
  Eigen::MatrixXd B_found_;
};

class ProductOp {
 public:
  using Scalar = double;
  explicit ProductOp(const ShiftedPencil& op) : op_(op) {}
  Eigen::Index rows() const { return op_.inverse.size(); }
  Eigen::Index cols() const { return op_.inverse.size(); }
  void perform_op(const double* x, double* y) const {
    op_.inverse.multiply(*op_.pencil.B, ConstMap(x, rows()), Map(y, rows()));
  }

 private:
  const ShiftedPencil& op_;
};

class GeneralOp {
 public:
  using Scalar = double;
  explicit GeneralOp(const Operator& op) : op_(op) {}
  Eigen::Index rows() const { return op_.size; }
  Eigen::Index cols() const { return op_.size; }
  void perform_op(const double* x, double* y) const {
    op_.apply(ConstMap(x, op_.size), Map(y, op_.size));
  }

 private:
  const Operator& op_;
};

int space(int count, int size) { return std::min(size, std::max(2 * count + 1, count + 20)); }

template <class Solver>
void run(Solver& solver, int count) {
  const auto converged = guarded([&] {
    solver.init();
    return solver.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance,
                          Spectra::SortRule::LargestMagn);
  });
  if (solver.info() == Spectra::CompInfo::Successful) return;
  throw_unconverged(static_cast<int>(converged), count, most_restarts);
}

}  // namespace

void throw_unconverged(int converged, int count, int restarts) {
  throw NumericalError(
      fmt::format("The eigenproblem was not solved: {} of {} values converged in {} restarts.\n"
                  "Try: more or fewer modes, another shift, or 'Solver' = Dense.",
                  converged, count, restarts));
}

void throw_broken_down() {
  throw NumericalError(
      "The eigenproblem was not solved: the vectors found do not fulfil its equations.\n"
      "Likely cause: more modes are asked for than the model has, or nothing in it is elastic.\n"
      "Try: fewer modes, or 'Solver' = Dense.");
}

InvertedPairs solve_lanczos(const ShiftedPencil& op, int count, const Eigen::MatrixXd& found) {
  SolveOp solve(op, found);
  ProductOp product(op);
  Spectra::SymGEigsShiftSolver<SolveOp, ProductOp, Spectra::GEigsMode::ShiftInvert> solver(
      solve, product, count, space(count, op.inverse.size()), op.shift);
  run(solver, count);
  return {(solver.eigenvalues().array() - op.shift).inverse(), solver.eigenvectors()};
}

GeneralPairs solve_arnoldi(const Operator& op, int count) {
  GeneralOp general(op);
  Spectra::GenEigsSolver<GeneralOp> solver(general, count, space(count, op.size));
  run(solver, count);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace culm::solver
