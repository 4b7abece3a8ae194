#include <culm/base/error.hpp>
#include <culm/solver/linear_solver.hpp>

#include "krylov.hpp"
#include "matrix_checks.hpp"
#include "multigrid.hpp"
#include "mumps_solver.hpp"
#include "residual_check.hpp"
#include "symmetry_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::tpetra;

// More iterations per digit than with new grids, by this factor and not just a few: they are made
// anew.
constexpr double slower = 1.5;
constexpr int some_iterations = 10;
constexpr int most_iterations = 300;
// Grids of another matrix: its diagonal sums up to something else.
constexpr double other_matrix = 0.1;
// What one run of an iteration can bring down before its recursion and the residual part.
constexpr double reduction_of_a_run = 1e-8;
// What the grids themselves and the vectors take [B per entry of the matrix]: measured on plates of
// 100 x 100 to 700 x 700 elements. Factors of the coarsest grid may have the rest.
constexpr double grids_need = 18.0;
// What counts as all digits, over |b| or over the largest terms of a row.
constexpr double all_digits = 1e-12;
constexpr double rounding = 1e-14;
constexpr double largest_asymmetry = 1e-12;

constexpr LinearResidual useless{1.0};

std::vector<std::size_t> places_of_diagonal(const CrsMatrix& matrix) {
  const auto local = matrix.getLocalMatrixHost();
  std::vector<std::size_t> places;
  for (int row = 0; row < local.numRows(); ++row) {
    const int diagonal =
        matrix.getColMap()->getLocalElement(matrix.getRowMap()->getGlobalElement(row));
    const auto at = static_cast<std::size_t>(row);
    for (auto k = local.graph.row_map(at); k < local.graph.row_map(at + 1); ++k) {
      if (local.graph.entries(k) == diagonal) places.push_back(k);
    }
  }
  return places;
}

class IterativeSolver final : public LinearSolver {
 public:
  IterativeSolver(const Teuchos::RCP<const CrsMatrix>& matrix, ModelBehind model,
                  const parallel::Comm& comm)
      : matrix_(matrix),
        model_(std::move(model)),
        comm_(comm),
        symmetry_(matrix),
        check_(matrix, comm),
        correction_(assembly::rows_of(matrix->getRowMap())),
        diagonal_(places_of_diagonal(*matrix)) {}

  std::string name() const override { return "Iterative"; }

  bool factor() override {
    if (!std::isfinite(comm_.max(largest_entry(*matrix_)))) return false;
    is_symmetric_ = comm_.max(symmetry_.asymmetry()) <= largest_asymmetry;
    if (direct_) return direct_->factor();
    const double sum = sum_of_diagonal();
    const bool is_other = std::abs(sum - built_sum_) > other_matrix * std::abs(built_sum_);
    if (!multigrid_ || is_stale_ || is_other) return renew() || factor_directly();
    multigrid_->refresh();
    is_new_ = false;
    built_for_ = {};
    return true;
  }

  LinearResidual solve(const Vector& b, Vector& x) override {
    return solve_roughly(b, x, all_digits);
  }

  LinearResidual solve_roughly(const Vector& b, Vector& x, double reduction) override {
    x.fill(0.0);
    if (!direct_ && is_stale_ && !renew() && !factor_directly()) return useless;
    if (direct_) return direct_->solve(b, x);
    const double size = b.norm();
    if (!std::isfinite(size)) return {size};
    if (size == 0.0) return {};
    std::optional<LinearResidual> reached = iterate(b, x, reduction);
    if (!reached && !is_new_) {
      if (build()) reached = iterate(b, x, reduction);
    }
    return reached ? *reached : solve_directly(b, x);
  }

  Determinant determinant() override { return direct_ ? direct_->determinant() : Determinant{}; }

  double weakest_direction(Vector& v) override {
    v.fill(0.0);
    const double size = comm_.max(largest_entry(*matrix_));
    if (!std::isfinite(size) || size == 0.0) return 0.0;
    build();
    multigrid_->weakest_direction(v);
    const double largest = v.largest();
    if (!(largest > 0.0)) return 0.0;
    v.scale(1.0 / largest);
    matrix_->apply(tpetra(v), tpetra(correction_));
    return correction_.largest() / size;
  }

  // What depends on earlier matrices ends with the step, so that it does not matter where a run was
  // stopped, or how often a step was tried.
  void remember_pivots() override { begin_anew(); }
  void restore_pivots() override { begin_anew(); }

  std::string remark() const override {
    if (solutions_ == 0) return {};
    std::string text = fmt::format("{:.1f} iterations per solution, at most {}; grids of",
                                   static_cast<double>(iterations_) / solutions_, most_);
    for (long long unknowns : sizes_) text += fmt::format(" {}", unknowns);
    text += fmt::format(" unknowns, made {} times", built_);
    if (lacks_memory_) text += "; with more memory it would take fewer grids and iterations";
    if (failed_ > 0) {
      text += fmt::format("; {} of {} solutions by MUMPS, where the iteration did not converge",
                          failed_, solutions_);
    }
    return text;
  }

 private:
  void begin_anew() {
    direct_.reset();
    is_stale_ = true;
  }

  double sum_of_diagonal() const {
    const auto local = matrix_->getLocalMatrixHost();
    double sum = 0.0;
    for (const std::size_t place : diagonal_) sum += std::abs(local.values(place));
    return comm_.sum(sum);
  }

  // All bits of the values on this rank.
  std::uint64_t fingerprint() const {
    const auto local = matrix_->getLocalMatrixHost();
    std::uint64_t print = 0;
    for (std::size_t i = 0; i < local.values.extent(0); ++i) {
      print = (print ^ std::bit_cast<std::uint64_t>(local.values(i))) * 0x100000001b3ULL;
      print ^= print >> 32;
    }
    return print;
  }

  // Grids of the present values: those that are there, if they were made of the same, else new
  // ones.
  bool renew() {
    const bool differs = !multigrid_ || !built_for_ || *built_for_ != fingerprint();
    if (comm_.max(differs ? 1 : 0) == 1) return build();
    is_stale_ = false;
    is_new_ = true;
    usual_ = 0.0;
    return multigrid_->is_regular();
  }

  bool build() {
    multigrid_.reset();  // before new ones take memory
    const double memory = model_.memory * comm_.size() -
                          grids_need * static_cast<double>(matrix_->getGlobalNumEntries());
    multigrid_ = std::make_unique<Multigrid>(matrix_, model_.motions(), memory, comm_);
    sizes_ = multigrid_->sizes();
    lacks_memory_ = multigrid_->lacks_memory();
    built_sum_ = sum_of_diagonal();
    built_for_ = fingerprint();
    is_stale_ = false;
    is_new_ = true;
    usual_ = 0.0;
    ++built_;
    return multigrid_->is_regular();
  }

  // Runs until the residual is small enough or as small as rounding leaves it. Starts from x = 0.
  // @return none if it does not get there
  std::optional<LinearResidual> iterate(const Vector& b, Vector& x, double reduction) {
    const double size = b.norm();
    double rest = size;
    double relative = 1.0;
    int spent = 0;
    bool is_definite = is_symmetric_ && multigrid_->may_be_definite();
    const auto is_reached = [&] { return rest <= reduction * size || relative <= rounding; };
    // old grids are replaced before they cost much
    const double usual = -std::log10(reduction) * slower * usual_ + some_iterations;
    const int most = is_new_ ? most_iterations : std::min(most_iterations, static_cast<int>(usual));
    x.fill(0.0);
    const Vector* left = &b;  // b - A x
    while (spent < most && !is_reached()) {
      KrylovGoal run;
      run.reduction = std::max(0.5 * reduction * size / rest, reduction_of_a_run);
      run.most_iterations = most - spent;
      correction_.fill(0.0);
      const KrylovEnd end = is_definite ? conjugate_gradients(*multigrid_, *left, correction_, run)
                                        : minimise_residual(*multigrid_, *left, correction_, run);
      spent += std::max(1, end.iterations);
      const double before = rest;
      if (std::isfinite(correction_.norm())) {
        x.update(1.0, correction_);
        relative = check_.keep_rest(b, x);
        left = &check_.rest();
        rest = left->norm();
      }
      if (rest > before) {
        x.update(-1.0, correction_);
        relative = check_.keep_rest(b, x);
        left = &check_.rest();
        rest = left->norm();
      }
      if (is_reached()) break;
      const bool helps = end.converged && rest < 0.5 * before;
      if (!helps && !is_definite) break;
      is_definite = is_definite && helps;
    }
    note(spent, std::log10(size / rest));
    if (!is_reached()) return {};
    if (rest <= reduction * size) return LinearResidual{rest / size, reduction};
    return LinearResidual{relative};
  }

  void note(int spent, double digits) {
    ++solutions_;
    iterations_ += spent;
    most_ = std::max(most_, spent);
    const double per_digit = spent / std::max(1.0, digits);
    if (is_new_ && usual_ == 0.0) usual_ = per_digit;
    if (!is_new_ && spent > some_iterations && per_digit > slower * usual_) is_stale_ = true;
  }

  // Of MUMPS [B].
  double need_of(const Ordering& ordering) const {
    return 8.0 * ordering.fill.entries * (is_symmetric_ ? 0.5 : 1.0);
  }
  double allowed() const { return model_.memory * comm_.size(); }  // all hold parts of the factors

  // The coarsest matrix may be singular where the whole is not, as with constraints as equations.
  // @return whether it is regular and there was memory to find out
  bool factor_directly() {
    Ordering ordering = order_rows(*matrix_, comm_);
    return need_of(ordering) <= allowed() && take_mumps(std::move(ordering));
  }

  bool take_mumps(Ordering ordering) {
    multigrid_.reset();
    is_stale_ = true;
    direct_ = make_mumps(matrix_, std::move(ordering), comm_);
    return direct_->factor();
  }

  LinearResidual solve_directly(const Vector& b, Vector& x) {
    Ordering ordering = order_rows(*matrix_, comm_);
    const double need = need_of(ordering);
    if (need > allowed()) {
      throw NumericalError(fmt::format(
          "The iterative solver did not converge in {} iterations, and the factors of MUMPS would "
          "need {:.2g} GB,\nmore than the {:.2g} GB that are allowed.\n"
          "Try: smaller steps, thicker or fewer elements, or more memory.",
          most_iterations, 1e-9 * need, 1e-9 * allowed()));
    }
    ++failed_;
    return take_mumps(std::move(ordering)) ? direct_->solve(b, x) : useless;
  }

  Teuchos::RCP<const CrsMatrix> matrix_;
  ModelBehind model_;
  parallel::Comm comm_;
  SymmetryCheck symmetry_;
  ResidualCheck check_;
  Vector correction_;
  std::vector<std::size_t> diagonal_;  // places among the values on this rank
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<LinearSolver> direct_;  // where the iteration did not converge in this step
  std::vector<long long> sizes_;          // of the grids
  bool lacks_memory_ = false;             // for fewer of them
  bool is_symmetric_ = false;
  bool is_stale_ = true;  // the grids are to be made anew
  bool is_new_ = false;   // they belong to the present values
  double built_sum_ = 0.0;
  std::optional<std::uint64_t> built_for_;  // what the grids were made of, unless refreshed since
  double usual_ = 0.0;                      // iterations per digit with new grids
  long iterations_ = 0;
  int solutions_ = 0, most_ = 0, built_ = 0, failed_ = 0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_iterative(const std::shared_ptr<const assembly::Matrix>& matrix,
                                             ModelBehind model, const parallel::Comm& comm) {
  return std::make_unique<IterativeSolver>(tpetra(*matrix), std::move(model), comm);
}

}  // namespace culm::solver
