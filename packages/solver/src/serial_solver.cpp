#include <culm/solver/linear_solver.hpp>

#include "guarded_block_lu.hpp"
#include "klu2.hpp"
#include "matrix_checks.hpp"
#include "one_rank_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;

// Of a matrix that is on this rank as a whole. Factors: Klu2 or GuardedBlockLu.
template <class Factors>
class SerialSolver final : public LinearSolver {
 public:
  SerialSolver(std::string name, Teuchos::RCP<const CrsMatrix> matrix)
      : name_(std::move(name)),
        matrix_(std::move(matrix)),
        factors_(*matrix_),
        first_columns_(first_columns(*matrix_)) {}

  std::string name() const override { return name_; }

  bool factor() override {
    has_solved_ = false;
    return factors_.factor();
  }

  bool factor_for(const Vector& b) override {
    if constexpr (begins_solutions) {
      has_solved_ = false;
      return factors_.factor_for(b.values());
    }
    return factor();
  }

  LinearResidual solve(const Vector& b, Vector& x) override {
    double relative = solve_once(b.values(), x.values());
    if (!(relative <= largest_residual_of_doubtful_pivots) && factors_.needs_proof(has_solved_)) {
      relative = factors_.factor_anew() ? solve_once(b.values(), x.values()) : HUGE_VAL;
    }
    has_solved_ = true;
    return {relative};
  }

  Determinant determinant() override { return factors_.determinant(); }

  double weakest_direction(Vector& v) override {
    v.fill(0.0);
    const double size = largest_entry(*matrix_);
    if (!std::isfinite(size) || size == 0.0) return 0.0;
    const auto shifted = shifted_copy(*matrix_, relative_shift * size);
    Factors factors(*shifted);
    if (!factors.factor()) return 0.0;
    const auto solve = [&](const Vector& b, Vector& x) {
      x = b;
      factors.solve(x.values());
    };
    return inverse_iteration(*matrix_, solve, v) / size;
  }

  std::vector<int> pivots() const override { return factors_.pivots(); }
  void remember_pivots() override { factors_.remember_pivots(); }
  void restore_pivots() override { factors_.restore_pivots(); }
  bool set_pivots(std::span<const int> pivots) override { return factors_.set_pivots(pivots); }

  std::string remark() const override {
    if constexpr (requires { factors_.remark(); }) return factors_.remark();
    return {};
  }

 private:
  static constexpr bool begins_solutions = requires(Factors f, std::span<double> x) {
    f.finish(x);
  };

  void apply_inverse(std::span<double> x) {
    if constexpr (begins_solutions) {
      factors_.finish(x);
    } else {
      factors_.solve(x);
    }
  }

  double solve_once(std::span<const double> b, std::span<double> x) {
    std::ranges::copy(b, x.begin());
    apply_inverse(x);
    const auto check = [&](std::span<double> rest) {
      return residual(*matrix_, first_columns_, {x, {}}, b, rest).relative();
    };
    const double achieved = check({});
    if (achieved <= largest_residual_of_doubtful_pivots || !factors_.wants_refinement()) {
      return achieved;
    }
    const auto correct = [&] {
      rest_.resize(b.size());
      check(rest_);
      factors_.solve(rest_);
      std::transform(x.begin(), x.end(), rest_.begin(), x.begin(), std::plus<>());
    };
    const auto undo = [&] {
      std::transform(x.begin(), x.end(), rest_.begin(), x.begin(), std::minus<>());
    };
    return refine(
        achieved, correct, [&] { return check({}); }, undo);
  }

  std::string name_;
  Teuchos::RCP<const CrsMatrix> matrix_;
  Factors factors_;
  std::vector<int> first_columns_;
  std::vector<double> rest_;  // of a solution that is refined
  bool has_solved_ = false;   // with the last factors
};

template <class Factors>
std::unique_ptr<LinearSolver> make_rooted(const std::string& name, const assembly::Matrix& matrix,
                                          const parallel::Comm& comm) {
  const auto make = [&](const auto& whole, const parallel::Comm&) {
    return std::make_unique<SerialSolver<Factors>>(name, whole);
  };
  return make_one_rank_solver(assembly::tpetra(matrix), make, comm);
}

}  // namespace

std::unique_ptr<LinearSolver> make_rooted_klu2(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm) {
  return make_rooted<Klu2>("KLU2", *matrix, comm);
}

std::unique_ptr<LinearSolver> make_rooted_block_lu(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm) {
  return make_rooted<GuardedBlockLu>("Block LU", *matrix, comm);
}

}  // namespace culm::solver
