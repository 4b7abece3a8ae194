#include <culm/solver/newton_solver.hpp>

#include "newton_group.hpp"

#include <NOX.H>
#include <Teuchos_oblackholestream.hpp>

#include <algorithm>
#include <cmath>

namespace culm::solver {
namespace {

// Newton's method ends far below the tolerance; with old factors or from a good first guess it ends
// just below, step after step on the same side, and what adds up over many steps would show it.
constexpr double lasting_share = 0.01;

// Share of a residual at the start of a step that does not count at its end.
constexpr double negligible = 1e-6;

// So many times what quadratic convergence leaves of a residual is rounding and no remainder.
constexpr double far_above = 10.0;

// Judges force and constraint rows separately, each relative to what it is made of.
class BalanceTest final : public NOX::StatusTest::Generic {
 public:
  explicit BalanceTest(NewtonProblem& problem) : problem_(problem) {}

  void reset() {
    history_.clear();
    residual_before_ = previous_residual_ = previous_violation_ = 0.0;
    status_ = NOX::StatusTest::Unevaluated;
  }
  const std::vector<IterationRecord>& history() const { return history_; }

  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver,
                                          NOX::StatusTest::CheckType) override {
    const auto& group = dynamic_cast<const NewtonGroup&>(solver.getSolutionGroup());
    const assembly::Evaluation& e = group.evaluation();
    const NewtonSettings& settings = problem_.settings;
    history_.push_back(
        {e.force_scale > 0.0 ? e.force_residual / e.force_scale : 0.0, e.constraint_violation});
    const bool at_once = problem_.stencil.inertia != 0.0 && history_.size() <= 2;
    const bool lasts = settings.refresh == Refresh::on_slow_convergence || at_once;
    const double share = lasts ? lasting_share : 1.0;
    const bool forces = e.force_residual <= share * settings.force_tolerance * e.force_scale ||
                        is_rounding(e.force_residual, e.round_off_force);
    // far from the origin rounding may hold a violation above the share
    const bool stalls = history_.size() > 1 && e.constraint_violation > 0.1 * previous_violation_;
    const bool constraints =
        e.constraint_violation <= (stalls ? 1.0 : share) * settings.constraint_tolerance;
    if (forces && constraints) learn_rounding(e);
    residual_before_ = previous_residual_;
    previous_residual_ = e.force_residual;
    previous_violation_ = e.constraint_violation;
    if (history_.size() == 1) first_residual_ = e.force_residual;
    status_ = forces && constraints ? NOX::StatusTest::Converged : NOX::StatusTest::Unconverged;
    if (is_hopeless(e)) status_ = NOX::StatusTest::Failed;
    return status_;
  }
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& stream, int) const override { return stream; }

 private:
  // Below the bound that rounding can explain a force may also be a small load on a structure that
  // is stiff elsewhere. So it must be negligible beside what was out of balance at first, or have
  // stopped falling. With old factors a residual creeps, so it must have stopped.
  bool is_rounding(double residual, double bound) const {
    if (residual == 0.0) return true;
    if (history_.size() < 2 || residual > bound) return false;
    if (problem_.settings.refresh == Refresh::on_slow_convergence) {
      return residual > 0.2 * previous_residual_;
    }
    if (residual > 0.1 * previous_residual_) return true;
    return residual <= expected_rounding(residual) * bound &&
           residual <= negligible * first_residual_;
  }
  // Rounding causes about a tenth of the bound, in long meshes up to a half: twice what it was seen
  // to cause, where inertia lets no direction be soft. What the iteration leaves must be far less,
  // for it always points the same way.
  double expected_rounding(double residual) const {
    if (problem_.stencil.inertia == 0.0 || history_.size() < 3) return 0.1;
    const double fall = previous_residual_ / residual_before_;
    const double remainder = fall * fall * previous_residual_;
    if (residual < far_above * remainder) return 0.1;
    return std::clamp(2.0 * problem_.seen_rounding, 0.1, 0.5);
  }
  // A residual that stands still shows what rounding causes, any other that it causes less.
  void learn_rounding(const assembly::Evaluation& e) {
    if (history_.size() < 2 || e.force_residual > e.round_off_force) return;
    const double share = e.force_residual / e.round_off_force;
    const bool stands_still = e.force_residual > 0.5 * previous_residual_;
    double& seen = problem_.seen_rounding;
    seen = stands_still ? share : std::min(seen, share);
  }
  // an increment of thousands of model lengths or hundreds of turns will not come back
  bool is_hopeless(const assembly::Evaluation& e) const {
    const double size = 1e3 * std::max(1.0, problem_.system.model().length());
    return e.verdict != Verdict::ok || (problem_.largest_increment > size && history_.size() > 1);
  }

  NewtonProblem& problem_;
  std::vector<IterationRecord> history_;
  double residual_before_ = 0.0;  // the last but one
  double previous_residual_ = 0.0;
  double previous_violation_ = 0.0;
  double first_residual_ = 0.0;
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

Teuchos::RCP<Teuchos::ParameterList> nox_parameters(const NewtonSettings& settings) {
  auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set("Nonlinear Solver", "Line Search Based");
  list->sublist("Line Search").set("Method", settings.backtrack ? "Backtrack" : "Full Step");
  list->sublist("Direction").set("Method", "Newton");
  // a failed linear solve leaves no direction; NOX would go on with what it finds
  list->sublist("Direction").sublist("Newton").set("Rescue Bad Newton Solve", false);
  Teuchos::ParameterList& printing = list->sublist("Printing");
  printing.set("Output Information", 0);
  // NOX reports a residual that cannot be computed whatever it was told; our outcome says it
  printing.set<Teuchos::RCP<std::ostream>>("Error Stream",
                                           Teuchos::rcp(new Teuchos::oblackholestream));
  return list;
}

}  // namespace

struct NewtonSolver::Nox {
  std::shared_ptr<NewtonProblem> problem;
  Teuchos::RCP<NewtonGroup> group;
  Teuchos::RCP<BalanceTest> balance;
  Teuchos::RCP<NOX::StatusTest::Combo> tests;
  Teuchos::RCP<NewtonVector> origin;
  Teuchos::RCP<NOX::Solver::Generic> solver;

  StepEnd find_end(NOX::StatusTest::StatusType status, const NewtonGroup& last) const {
    if (status == NOX::StatusTest::Converged) return StepEnd::converged;
    if (last.evaluation().verdict == Verdict::not_finite) return StepEnd::not_finite;
    if (last.evaluation().verdict != Verdict::ok) return StepEnd::out_of_range;
    if (problem->not_finite) return StepEnd::not_finite;
    if (problem->singular) return StepEnd::singular;
    const auto iterations = static_cast<int>(balance->history().size()) - 1;
    if (iterations >= problem->settings.max_iterations) return StepEnd::too_many_iterations;
    return StepEnd::diverged;
  }
};

std::string describe(StepEnd end) {
  switch (end) {
    case StepEnd::converged:
      return "converged";
    case StepEnd::too_many_iterations:
      return "the iteration limit was reached";
    case StepEnd::diverged:
      return "the iteration diverged";
    case StepEnd::singular:
      return "the tangent is singular";
    case StepEnd::not_finite:
      return "a force became infinite or not a number";
    case StepEnd::out_of_range:
      return "an element turned beyond its range or a law left its domain";
    case StepEnd::turned_too_far:
      return "a node turned too far in one step";
    case StepEnd::off_path:
      return "the solution does not continue the path";
    case StepEnd::inaccurate:
      return "the error of the step is far above the tolerance";
  }
  return {};
}

NewtonSolver::NewtonSolver(assembly::System& system, LinearSolver& linear,
                           const NewtonSettings& settings, Ledger& ledger)
    : nox_(std::make_unique<Nox>()) {
  Ledger::Entry factor;
  factor.name = "Factorisation, " + linear.name();
  factor.unknowns = system.model().unknowns().num_unknowns();
  const Ledger::Id factor_effect = ledger.add(factor);
  const Ledger::Id solve_effect = ledger.add("Solution, " + linear.name());
  nox_->problem = std::make_shared<NewtonProblem>(
      NewtonProblem{system, linear, settings, ledger, factor_effect, solve_effect, nullptr, {}});
  nox_->group = Teuchos::rcp(new NewtonGroup(nox_->problem));
  nox_->balance = Teuchos::rcp(new BalanceTest(*nox_->problem));
  nox_->origin = Teuchos::rcp(new NewtonVector(system.layout().row_map()));
  nox_->tests = Teuchos::rcp(new NOX::StatusTest::Combo(NOX::StatusTest::Combo::OR));
  nox_->tests->addStatusTest(nox_->balance);
  nox_->tests->addStatusTest(Teuchos::rcp(new NOX::StatusTest::MaxIters(settings.max_iterations)));
  nox_->solver = NOX::Solver::buildSolver(nox_->group, nox_->tests, nox_parameters(settings));
}

NewtonSolver::~NewtonSolver() = default;

StepOutcome NewtonSolver::solve(model::State& state, const Stencil& stencil,
                                LevelCondition* condition) {
  Nox& nox = *nox_;
  nox.problem->state = &state;
  nox.problem->stencil = stencil;
  nox.problem->condition = condition;
  if (condition != nullptr && nox.problem->level_gradient.is_null()) {
    nox.problem->level_gradient = Teuchos::rcp(new assembly::Vector(nox.origin->get().getMap()));
    nox.problem->level_flexibility = Teuchos::rcp(new assembly::Vector(nox.origin->get().getMap()));
  }
  nox.problem->first_determinant = {};
  nox.problem->singular = nox.problem->not_finite = false;
  nox.problem->largest_increment = nox.problem->last_residual = 0.0;
  nox.problem->iterations = 0;
  nox.balance->reset();
  nox.group->start();
  nox.origin->init(0.0);

  NOX::StatusTest::StatusType status = NOX::StatusTest::Failed;
  nox.group->setX(*nox.origin);
  // NOX throws when the residual fails at the start of a step; that is an outcome, not an error
  if (nox.group->computeF() == NOX::Abstract::Group::Ok) {
    nox.solver->reset(*nox.origin);
    try {
      status = nox.solver->solve();
    } catch (const char*) {
      // how NOX ends when there is no Newton direction; find_end knows the reason
    }
  }
  StepOutcome outcome;
  outcome.end = nox.find_end(status, *nox.group);
  outcome.history = nox.balance->history();
  outcome.iterations = std::max(0, static_cast<int>(outcome.history.size()) - 1);
  outcome.last = nox.group->evaluation();
  outcome.first_determinant = nox.problem->first_determinant;
  if (outcome.first_determinant.sign != 0 && outcome.converged()) {
    outcome.last_determinant = nox.problem->linear.determinant();
  }
  if (!outcome.converged()) nox.problem->has_factors = false;
  nox.problem->expected_iterations = outcome.converged() ? outcome.iterations : 0;
  nox.group->finish();
  return outcome;
}

void NewtonSolver::save(Snapshot& snapshot) const {
  const NewtonProblem& p = *nox_->problem;
  const std::vector<int> pivots = p.linear.pivots();
  snapshot.set("newton/pivots", {pivots.begin(), pivots.end()});
  snapshot.set("newton/expected iterations", p.expected_iterations);
  snapshot.set("newton/seen rounding", p.seen_rounding);
  if (p.settings.refresh == Refresh::every_iteration || !p.has_factors) return;
  // the matrix has not changed since it was factored
  snapshot.set("newton/inertia", p.factored_inertia);
  p.system.save_matrix(snapshot);
}

void NewtonSolver::restore(const Snapshot& snapshot) {
  NewtonProblem& p = *nox_->problem;
  p.expected_iterations = snapshot.integer("newton/expected iterations");
  p.seen_rounding = snapshot.number("newton/seen rounding");
  const std::vector<double>& kept = snapshot.numbers("newton/pivots");
  // where they do not fit, the solver begins anew
  p.linear.set_pivots(std::vector<int>(kept.begin(), kept.end()));
  if (p.settings.refresh == Refresh::every_iteration || !snapshot.has("newton/inertia")) return;
  p.factored_inertia = snapshot.number("newton/inertia");
  p.has_factors = p.system.restore_matrix(snapshot) && p.linear.factor();
}

}  // namespace culm::solver
