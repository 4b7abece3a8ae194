#include "mumps_solver.hpp"

#include "matrix_checks.hpp"
#include "mumps.hpp"
#include "residual_check.hpp"
#include "rooted_vector.hpp"
#include "symmetry_check.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::tpetra;

class MumpsSolver final : public LinearSolver {
 public:
  MumpsSolver(const Teuchos::RCP<const CrsMatrix>& matrix, Ordering ordering,
              const parallel::Comm& comm)
      : matrix_(matrix),
        comm_(comm),
        place_(std::move(ordering.place)),
        symmetry_(matrix),
        rooted_(assembly::rows_of(matrix->getRowMap()), comm),
        whole_(comm.is_root() ? matrix->getGlobalNumRows() : 0),
        check_(matrix, comm),
        correction_(assembly::rows_of(matrix->getRowMap())) {}

  std::string name() const override { return "MUMPS"; }

  // By the present values alone, so that what goes on where a run stopped decides alike. Hardly any
  // analysis has matrices of both kinds, so one set of factors is held and not two.
  bool factor() override {
    if (!std::isfinite(size())) return false;
    const Symmetry symmetry = find_symmetry();
    if (!mumps_ || mumps_->symmetry() != symmetry) {
      mumps_.reset();
      mumps_.emplace(*matrix_, symmetry, place_, comm_);
    }
    return mumps_->factor(*matrix_);
  }

  LinearResidual solve(const Vector& b, Vector& x) override {
    apply_inverse(*mumps_, b, x);
    // Pivots are chosen inside a front only, so one step of refinement may be worth its cost.
    const auto correct = [&] {
      apply_inverse(*mumps_, check_.rest(), correction_);
      x.update(1.0, correction_);
    };
    const double achieved = refine(
        check_(b, x), correct, [&] { return check_(b, x); }, [&] { x.update(-1.0, correction_); });
    return {achieved};
  }

  Determinant determinant() override { return mumps_ ? mumps_->determinant() : Determinant{}; }

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

 private:
  // What is beyond, refinement finds in the residual.
  static constexpr double largest_asymmetry = 1e-12;

  double size() const { return comm_.max(largest_entry(*matrix_)); }

  Symmetry find_symmetry() {
    return comm_.max(symmetry_.asymmetry()) <= largest_asymmetry ? Symmetry::symmetric
                                                                 : Symmetry::none;
  }

  void apply_inverse(Mumps& mumps, const Vector& b, Vector& x) {
    rooted_.gather(b.values(), whole_);
    mumps.solve(whole_);
    rooted_.scatter(whole_, x.values());
  }

  Teuchos::RCP<const CrsMatrix> matrix_;
  parallel::Comm comm_;
  std::vector<int> place_;
  std::optional<Mumps> mumps_;  // of the symmetry of the last matrix
  SymmetryCheck symmetry_;
  RootedVector rooted_;
  std::vector<double> whole_;  // a vector in global order, on the root
  ResidualCheck check_;
  Vector correction_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_mumps(const Teuchos::RCP<const CrsMatrix>& matrix,
                                         Ordering ordering, const parallel::Comm& comm) {
  return std::make_unique<MumpsSolver>(matrix, std::move(ordering), comm);
}

std::unique_ptr<LinearSolver> make_mumps(const std::shared_ptr<const assembly::Matrix>& matrix,
                                         const parallel::Comm& comm) {
  return make_mumps(tpetra(*matrix), order_rows(*tpetra(*matrix), comm), comm);
}

}  // namespace culm::solver
