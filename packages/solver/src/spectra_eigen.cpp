#include <culm/base/error.hpp>

#include "eigen_methods.hpp"

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>

namespace culm::solver {
namespace {

using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using Map = Eigen::Map<Eigen::VectorXd>;

// Names as Spectra wants them.
class SolveOp {
 public:
  using Scalar = double;
  SolveOp(ShiftInvert& op, const Eigen::MatrixXd& found) : op_(op), found_(found) {
    B_found_.resizeLike(found);
    for (Eigen::Index i = 0; i < found.cols(); ++i) op.multiply_B(found.col(i), B_found_.col(i));
  }
  Eigen::Index rows() const { return op_.size(); }
  Eigen::Index cols() const { return op_.size(); }
  void set_shift(double) const {}  // it is factored
  void perform_op(const double* x, double* y) const {
    Map result(y, rows());
    op_.solve(ConstMap(x, rows()), result);
    if (found_.cols() > 0) result -= found_ * (B_found_.transpose() * result);
  }

 private:
  ShiftInvert& op_;
  const Eigen::MatrixXd& found_;
  Eigen::MatrixXd B_found_;
};

class MassOp {
 public:
  using Scalar = double;
  explicit MassOp(const ShiftInvert& op) : op_(op) {}
  Eigen::Index rows() const { return op_.size(); }
  Eigen::Index cols() const { return op_.size(); }
  void perform_op(const double* x, double* y) const {
    op_.multiply_B(ConstMap(x, rows()), Map(y, rows()));
  }

 private:
  const ShiftInvert& op_;
};

}  // namespace

InvertedPairs solve_spectra(ShiftInvert& op, int count, const Eigen::MatrixXd& found) {
  constexpr int most_restarts = 300;
  constexpr double tolerance = 1e-11;
  SolveOp solve(op, found);
  MassOp mass(op);
  const int space = std::min(op.size(), std::max(2 * count + 1, count + 20));
  Spectra::SymGEigsShiftSolver<SolveOp, MassOp, Spectra::GEigsMode::ShiftInvert> solver(
      solve, mass, count, space, op.shift());
  solver.init();
  const auto converged = solver.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance,
                                        Spectra::SortRule::LargestMagn);
  if (solver.info() != Spectra::CompInfo::Successful) {
    throw NumericalError(
        fmt::format("The eigenproblem was not solved: {} of {} values converged in {} restarts.\n"
                    "Try: more or fewer modes, another shift, or 'Solver' = Dense.",
                    converged, count, most_restarts));
  }
  InvertedPairs pairs;
  pairs.nu = (solver.eigenvalues().array() - op.shift()).inverse();
  pairs.vectors = solver.eigenvectors();
  return pairs;
}

}  // namespace culm::solver
