#include "krylov.hpp"

#include <BelosLinearProblem.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>
#include <BelosPseudoBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <Tpetra_Operator.hpp>

namespace culm::solver {
namespace {

using assembly::Map;
using assembly::Vector;
using MultiVector = Tpetra::MultiVector<>;
using LinearOp = Tpetra::Operator<>;

constexpr int before_restart = 60;

// What Belos calls: the matrix, or its approximate inverse. Belos has one right-hand side.
template <class Product>
class Applied final : public LinearOp {
 public:
  Applied(Teuchos::RCP<const Map> map, Product product)
      : map_(std::move(map)), product_(std::move(product)) {}

  Teuchos::RCP<const Map> getDomainMap() const override { return map_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp, double alpha,
             double beta) const override {
    const auto x = X.getVector(0);
    const auto y = Y.getVectorNonConst(0);
    if (alpha == 1.0 && beta == 0.0) {
      Vector result = assembly::view_of(*y);
      product_(assembly::view_of(*x), result);
      return;
    }
    Vector product(assembly::rows_of(map_));
    product_(assembly::view_of(*x), product);
    y->update(alpha, assembly::tpetra(product), beta);
  }

 private:
  Teuchos::RCP<const Map> map_;
  Product product_;
};

template <class Product>
Teuchos::RCP<LinearOp> as_operator(const Vector& like, Product product) {
  return Teuchos::rcp(new Applied<Product>(assembly::tpetra(like.rows()), std::move(product)));
}

using Problem = Belos::LinearProblem<double, MultiVector, LinearOp>;

Teuchos::RCP<Problem> set_up(Multigrid& multigrid, const Vector& b, Vector& x, bool right) {
  const auto matrix =
      as_operator(b, [&multigrid](const Vector& in, Vector& out) { multigrid.multiply(in, out); });
  const auto inverse =
      as_operator(b, [&multigrid](const Vector& in, Vector& out) { multigrid.apply(in, out); });
  const auto problem =
      Teuchos::rcp(new Problem(matrix, Teuchos::rcpFromRef<MultiVector>(assembly::tpetra(x)),
                               Teuchos::rcpFromRef<const MultiVector>(assembly::tpetra(b))));
  if (right) {
    problem->setRightPrec(inverse);
  } else {
    problem->setLeftPrec(inverse);
  }
  problem->setProblem();
  return problem;
}

Teuchos::RCP<Teuchos::ParameterList> parameters(const KrylovGoal& goal) {
  auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set("Convergence Tolerance", goal.reduction);
  list->set("Maximum Iterations", goal.most_iterations);
  list->set("Verbosity", static_cast<int>(Belos::Errors));
  const Teuchos::RCP<std::ostream> nowhere = Teuchos::rcp(new Teuchos::oblackholestream);
  list->set("Output Stream", nowhere);
  return list;
}

template <class Solver>
KrylovEnd run(const Teuchos::RCP<Problem>& problem,
              const Teuchos::RCP<Teuchos::ParameterList>& list) {
  Solver solver(problem, list);
  KrylovEnd end;
  try {
    end.converged = solver.solve() == Belos::Converged;
  } catch (const Belos::BelosError&) {
    // a direction without positive energy, or numbers that are not finite
  }
  end.iterations = solver.getNumIters();
  return end;
}

}  // namespace

KrylovEnd conjugate_gradients(Multigrid& multigrid, const Vector& b, Vector& x,
                              const KrylovGoal& goal) {
  const auto list = parameters(goal);
  list->set("Residual Scaling", "Norm of RHS");
  list->set("Assert Positive Definiteness", true);
  return run<Belos::PseudoBlockCGSolMgr<double, MultiVector, LinearOp>>(
      set_up(multigrid, b, x, false), list);
}

KrylovEnd minimise_residual(Multigrid& multigrid, const Vector& b, Vector& x,
                            const KrylovGoal& goal) {
  const auto list = parameters(goal);
  list->set("Implicit Residual Scaling", "Norm of RHS");
  list->set("Explicit Residual Scaling", "Norm of RHS");
  list->set("Num Blocks", before_restart);
  list->set("Maximum Restarts", goal.most_iterations / before_restart);
  return run<Belos::PseudoBlockGmresSolMgr<double, MultiVector, LinearOp>>(
      set_up(multigrid, b, x, true), list);
}

}  // namespace culm::solver
