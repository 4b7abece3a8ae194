#include <culm/solver/linear_solver.hpp>

#include "matrix_checks.hpp"
#include "rooted_matrix.hpp"

#include <Amesos2.hpp>

#include <cmath>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::values_of;
using MultiVector = Tpetra::MultiVector<>;
using Klu2 = Amesos2::Solver<CrsMatrix, MultiVector>;

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
    double relative = 0.0;
    if (comm_.is_root()) {
      klu_->solve(&rooted_.solution(), &rooted_.rhs());
      relative =
          residual(*rooted_.matrix(), values_of(rooted_.solution()), values_of(rooted_.rhs()), {})
              .relative();
    }
    rooted_.scatter_solution(x);
    return comm_.max(relative);
  }

  double weakest_direction(Vector& v) override {
    rooted_.gather_values();
    double ratio = 0.0;
    if (comm_.is_root()) ratio = iterate_at_root();
    rooted_.scatter_solution(v);
    return comm_.max(ratio);
  }

 private:
  double iterate_at_root() {
    const Teuchos::RCP<CrsMatrix>& A = rooted_.matrix();
    Vector& v = rooted_.solution();
    v.putScalar(0.0);
    const double size = largest_entry(*A);
    if (!std::isfinite(size) || size == 0.0) return 0.0;
    const auto klu =
        Amesos2::create<CrsMatrix, MultiVector>("KLU2", shifted_copy(*A, relative_shift * size));
    try {
      klu->symbolicFactorization().numericFactorization();
    } catch (const std::exception&) {  // how Amesos2 reports a zero pivot
      return 0.0;
    }
    const auto solve = [&](const Vector& b, Vector& x) { klu->solve(&x, &b); };
    return inverse_iteration(*A, solve, v) / size;
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
