#include "mumps_solver.hpp"

#include "matrix_checks.hpp"
#include "mumps.hpp"
#include "mumps_parts.hpp"
#include "residual_check.hpp"
#include "rooted_vector.hpp"
#include "symmetry_check.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::tpetra;

class MumpsSolver final : public LinearSolver {
 public:
  // @param parts  tried first; or none
  MumpsSolver(const Teuchos::RCP<const CrsMatrix>& matrix, Ordering ordering,
              std::unique_ptr<MumpsParts> parts, const parallel::Comm& comm)
      : matrix_(matrix),
        comm_(comm),
        place_(std::move(ordering.place)),
        parts_(std::move(parts)),
        symmetry_(matrix),
        rooted_(assembly::rows_of(matrix->getRowMap()), comm),
        whole_(comm.is_root() ? matrix->getGlobalNumRows() : 0),
        check_(matrix, comm) {}

  std::string name() const override { return "MUMPS"; }

  // Not again what was factored last, as in linear models, or where a first iteration begins at the
  // point that was searched for mechanisms. By the present values alone, so that what goes on where
  // a run stopped decides alike. Hardly any analysis has matrices of both kinds, so one set of
  // factors is held and not two.
  bool factor() override {
    const std::uint64_t present = fingerprint(*matrix_);
    if (comm_.max(factored_ == present ? 0.0 : 1.0) == 0.0) return true;
    factored_.reset();
    if (!std::isfinite(size())) return false;
    const Symmetry symmetry = find_symmetry();
    if (!(parts_ && parts_->factor(symmetry)) && !factor_whole(symmetry)) return false;
    factored_ = present;
    return true;
  }

  LinearResidual solve(const Vector& b, Vector& x) override {
    double achieved = solve_refined(b, x);
    if (parts_ && achieved > largest_residual_of_doubtful_pivots && factor_whole(find_symmetry())) {
      achieved = solve_refined(b, x);
    }
    return {achieved};
  }

  Determinant determinant() override {
    if (parts_) return parts_->determinant();
    return mumps_ ? mumps_->determinant() : Determinant{};
  }

  double weakest_direction(Vector& v) override {
    v.fill(0.0);
    const double largest = size();
    if (!std::isfinite(largest) || largest == 0.0) return 0.0;
    const auto shifted = shifted_copy(*matrix_, relative_shift * largest);
    Mumps mumps(*shifted, Symmetry::none, place_, comm_);
    if (!mumps.factor(*shifted)) return 0.0;
    const auto solve = [&](const Vector& b, Vector& x) { apply_inverse(mumps, b, x); };
    return inverse_iteration(*matrix_, solve, v) / largest;
  }

  std::string remark() const override {
    if (parts_) return parts_->remark();
    return has_left_parts_ ? "factors on all ranks together, because parts do not stand alone" : "";
  }

 private:
  // What is beyond, refinement finds in the residual.
  static constexpr double largest_asymmetry = 1e-12;

  double size() const { return comm_.max(largest_entry(*matrix_)); }

  Symmetry find_symmetry() {
    return comm_.max(symmetry_.asymmetry()) <= largest_asymmetry ? Symmetry::symmetric
                                                                 : Symmetry::none;
  }

  // For good, if it serves: where parts do not stand alone, they will not next time either.
  bool factor_whole(Symmetry symmetry) {
    if (!mumps_ || mumps_->symmetry() != symmetry) {
      mumps_.reset();
      mumps_.emplace(*matrix_, symmetry, place_, comm_);
    }
    if (!mumps_->factor(*matrix_)) {
      if (parts_) mumps_.reset();
      return false;
    }
    has_left_parts_ |= parts_ != nullptr;
    parts_.reset();
    return true;
  }

  double solve_refined(const Vector& b, Vector& x) {
    apply_inverse(b, x);
    // Pivots are chosen inside a front only, so one step of refinement may be worth its cost.
    const auto correct = [&] {
      if (!correction_) correction_.emplace(b.rows());
      check_.keep_rest(b, x);
      apply_inverse(check_.rest(), *correction_);
      x.update(1.0, *correction_);
    };
    return refine(
        check_(b, x), correct, [&] { return check_(b, x); }, [&] { x.update(-1.0, *correction_); });
  }

  void apply_inverse(const Vector& b, Vector& x) {
    if (parts_) return parts_->solve(b, x);
    apply_inverse(*mumps_, b, x);
  }

  void apply_inverse(Mumps& mumps, const Vector& b, Vector& x) {
    rooted_.gather(b.values(), whole_);
    mumps.solve(whole_);
    rooted_.scatter(whole_, x.values());
  }

  Teuchos::RCP<const CrsMatrix> matrix_;
  parallel::Comm comm_;
  std::vector<int> place_;
  std::unique_ptr<MumpsParts> parts_;
  bool has_left_parts_ = false;
  std::optional<Mumps> mumps_;             // of the symmetry of the last matrix
  std::optional<std::uint64_t> factored_;  // fingerprint of what the factors are of, if they serve
  SymmetryCheck symmetry_;
  RootedVector rooted_;
  std::vector<double> whole_;  // a vector in global order, on the root
  ResidualCheck check_;
  std::optional<Vector> correction_;  // where solutions are refined
};

// A MUMPS on two ranks is 1.65 times faster than on one, not twice (doc/verification/speed.md).
constexpr double loss_of_sharing = 1.2;

}  // namespace

std::unique_ptr<LinearSolver> make_mumps(const Teuchos::RCP<const CrsMatrix>& matrix,
                                         Ordering ordering, const parallel::Comm& comm) {
  return std::make_unique<MumpsSolver>(matrix, std::move(ordering), nullptr, comm);
}

std::unique_ptr<LinearSolver> make_shared_mumps(const Teuchos::RCP<const CrsMatrix>& matrix,
                                                Ordering ordering, const parallel::Comm& comm) {
  auto parts = std::make_unique<MumpsParts>(matrix, comm);
  const double share = ordering.fill.operations / static_cast<double>(comm.size());
  if (parts->operations() > loss_of_sharing * share) parts.reset();
  return std::make_unique<MumpsSolver>(matrix, std::move(ordering), std::move(parts), comm);
}

std::unique_ptr<LinearSolver> make_mumps(const std::shared_ptr<const assembly::Matrix>& matrix,
                                         const parallel::Comm& comm) {
  return make_mumps(tpetra(*matrix), order_rows(*tpetra(*matrix), comm), comm);
}

}  // namespace culm::solver
