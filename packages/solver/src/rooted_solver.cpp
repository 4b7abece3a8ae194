#include <culm/solver/linear_solver.hpp>

#include "guarded_block_lu.hpp"
#include "klu2.hpp"
#include "matrix_checks.hpp"
#include "rooted_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;

constexpr double infinite = std::numeric_limits<double>::infinity();

// Factors: Klu2 or GuardedBlockLu.
template <class Factors>
class RootedSolver final : public LinearSolver {
 public:
  RootedSolver(std::string name, const Teuchos::RCP<const CrsMatrix>& matrix,
               const parallel::Comm& comm)
      : name_(std::move(name)), comm_(comm), rooted_(matrix, comm) {
    if (comm_.is_root()) factors_.emplace(*rooted_.matrix());
  }

  std::string name() const override { return name_; }

  bool factor() override {
    rooted_.gather_values();
    const bool sound = !comm_.is_root() || factors_->factor();
    has_solved_ = false;
    return comm_.max(sound ? 0 : 1) == 0;
  }

  LinearResidual solve(const Vector& b, Vector& x) override {
    rooted_.gather_rhs(b);
    double relative = 0.0;
    if (comm_.is_root()) {
      relative = solve_on_root();
      if (!(relative <= largest_residual_of_doubtful_pivots) &&
          factors_->needs_proof(has_solved_)) {
        relative = factors_->factor_anew() ? solve_on_root() : infinite;
      }
      has_solved_ = true;
    }
    rooted_.scatter_solution(x);
    return {comm_.max(relative)};
  }

  Determinant determinant() override {
    const Determinant d = factors_ ? factors_->determinant() : Determinant{};
    std::array<double, 2> both = {static_cast<double>(d.sign), d.log_size};
    comm_.sum(both);  // other ranks have zeros
    return {static_cast<int>(both[0]), both[1]};
  }

  double weakest_direction(Vector& v) override {
    rooted_.gather_values();
    double ratio = 0.0;
    if (comm_.is_root()) ratio = iterate_at_root();
    rooted_.scatter_solution(v);
    return comm_.max(ratio);
  }

  std::vector<int> pivots() const override {
    return factors_ ? factors_->pivots() : std::vector<int>{};
  }

  void remember_pivots() override {
    if (factors_) factors_->remember_pivots();
  }
  void restore_pivots() override {
    if (factors_) factors_->restore_pivots();
  }

  bool set_pivots(std::span<const int> pivots) override {
    const bool fit = !comm_.is_root() || factors_->set_pivots(pivots);
    return comm_.max(fit ? 0 : 1) == 0;
  }

  std::string remark() const override {
    if constexpr (requires { factors_->remark(); }) return factors_ ? factors_->remark() : "";
    return {};
  }

 private:
  double solve_on_root() {
    const auto x = rooted_.solution().values();
    const auto b = std::as_const(rooted_.rhs()).values();
    std::copy(b.begin(), b.end(), x.begin());
    factors_->solve(x);
    const auto check = [&](std::span<double> rest) {
      return residual(*rooted_.matrix(), x, b, rest).relative();
    };
    const double achieved = check({});
    if (achieved <= largest_without_refinement || !factors_->wants_refinement()) return achieved;
    const auto correct = [&] {
      rest_.resize(b.size());
      check(rest_);
      factors_->solve(rest_);
      std::transform(x.begin(), x.end(), rest_.begin(), x.begin(), std::plus<>());
    };
    const auto undo = [&] {
      std::transform(x.begin(), x.end(), rest_.begin(), x.begin(), std::minus<>());
    };
    return refine(
        achieved, correct, [&] { return check({}); }, undo);
  }

  double iterate_at_root() {
    const Teuchos::RCP<CrsMatrix>& A = rooted_.matrix();
    Vector& v = rooted_.solution();
    v.fill(0.0);
    const double size = largest_entry(*A);
    if (!std::isfinite(size) || size == 0.0) return 0.0;
    const auto shifted = shifted_copy(*A, relative_shift * size);
    Factors factors(*shifted);
    if (!factors.factor()) return 0.0;
    const auto solve = [&](const Vector& b, Vector& x) {
      x = b;
      factors.solve(x.values());
    };
    return inverse_iteration(*A, solve, v) / size;
  }

  std::string name_;
  parallel::Comm comm_;
  RootedMatrix rooted_;
  std::optional<Factors> factors_;  // on the root
  std::vector<double> rest_;        // of a solution that is refined
  bool has_solved_ = false;         // with the last factors
};

}  // namespace

std::unique_ptr<LinearSolver> make_rooted_klu2(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm) {
  return std::make_unique<RootedSolver<Klu2>>("KLU2", assembly::tpetra(*matrix), comm);
}

std::unique_ptr<LinearSolver> make_rooted_block_lu(
    const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm) {
  return std::make_unique<RootedSolver<GuardedBlockLu>>("Block LU", assembly::tpetra(*matrix),
                                                        comm);
}

}  // namespace culm::solver
