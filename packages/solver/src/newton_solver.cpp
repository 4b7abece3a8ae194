#include <culm/model/method_limits.hpp>
#include <culm/solver/newton_solver.hpp>

#include "late_search.hpp"
#include "newton_group.hpp"

#include <NOX.H>
#include <Teuchos_oblackholestream.hpp>

#include <algorithm>

namespace culm::solver {
namespace {

// Newton's method ends far below the tolerance; with old factors, from a good first guess or where
// something is left out of the tangent it ends just below, step after step on the same side, and
// what adds up over many steps would show it.
constexpr double lasting_share = 0.01;

// So many times what the iteration can leave of a residual is rounding and no remainder.
constexpr double far_above = 10.0;

// Share of the bound on rounding that is usually left; no iteration will get far below.
constexpr double usual = 0.2;

// A residual that keeps so much of itself with a new tangent does not fall any more.
constexpr double still = 0.7;

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
  // The row that rounding held above the tolerance when the iteration converged.
  const std::optional<int>& held_unknown() const { return held_unknown_; }

  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver,
                                          NOX::StatusTest::CheckType) override {
    const auto& group = dynamic_cast<const NewtonGroup&>(solver.getSolutionGroup());
    const assembly::Evaluation& e = group.evaluation();
    const NewtonSettings& settings = problem_.settings;
    history_.push_back(
        {e.force_scale > 0.0 ? e.force_residual / e.force_scale : 0.0, e.constraint_violation});
    const bool moves = problem_.stencil.inertia != 0.0;
    const bool lasts = settings.refresh == Refresh::on_slow_convergence ||
                       (moves && (history_.size() <= 2 || problem_.creeps));
    const bool may_go_on = static_cast<int>(history_.size()) <= settings.max_iterations;
    const double share = lasts && may_go_on ? lasting_share : 1.0;
    const double limit = settings.force_tolerance * e.force_scale;
    held_unknown_.reset();
    const bool forces =
        e.force_residual <= share * limit || is_held_by_rounding(group, share * limit, limit);
    // far from the origin rounding may hold a violation above the share
    const bool stalls = history_.size() > 1 && e.constraint_violation > 0.1 * previous_violation_;
    const bool constraints =
        e.constraint_violation <= (stalls ? 1.0 : share) * settings.constraint_tolerance;
    residual_before_ = previous_residual_;
    previous_residual_ = e.force_residual;
    previous_violation_ = e.constraint_violation;
    status_ = forces && constraints ? NOX::StatusTest::Converged : NOX::StatusTest::Unconverged;
    if (is_hopeless(e)) status_ = NOX::StatusTest::Failed;
    return status_;
  }
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& stream, int) const override { return stream; }

 private:
  // Between the share and the tolerance it is enough that rounding can explain what is left. Above
  // the tolerance it must be what rounding leaves anyway, or the iteration must have done its work.
  bool is_held_by_rounding(const NewtonGroup& group, double from, double limit) {
    if (history_.size() < 2) return false;
    const double residual = group.evaluation().force_residual;
    constexpr double most = 1.0;  // that rounding explains
    const assembly::RoundingCheck check = group.check_rounding(from, most);
    if (check.share > most) return false;
    // inertia lets no direction be soft, so that what is as small as rounding moves nothing; what
    // old factors leave, or a tangent without some force, always points the same way
    const bool is_usual =
        problem_.stencil.inertia != 0.0 && has_whole_direction() && check.share <= usual;
    if (residual > limit && !is_usual && !has_ended(residual)) return false;
    if (residual > limit) held_unknown_ = check.unknown;
    return true;
  }
  bool has_whole_direction() const {
    return problem_.direction_is_fresh && problem_.tangent_is_whole;
  }
  // A new tangent squares the ratio of two residuals. What is far above that no iteration will
  // lower, and neither what stands still.
  bool has_ended(double residual) const {
    if (!problem_.direction_is_fresh) return false;
    if (residual > still * previous_residual_) return true;
    if (residual_before_ == 0.0 || !problem_.tangent_is_whole) return false;
    const double fall = previous_residual_ / residual_before_;
    return residual > far_above * fall * fall * previous_residual_;
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
  std::optional<int> held_unknown_;
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

bool has_whole_tangent(const model::Model& model) {
  return std::ranges::none_of(model.batches(), [](const model::Batch* batch) {
    const auto* partly = dynamic_cast<const model::LeftOutOfModes*>(batch);
    return partly != nullptr && !partly->left_out_of_modes().empty();
  });
}

bool has_partial_tangent(const model::Model& model) {
  return std::ranges::any_of(model.batches(), [](const model::Batch* batch) {
    return dynamic_cast<const model::PartialTangent*>(batch) != nullptr;
  });
}

Teuchos::RCP<Teuchos::ParameterList> nox_parameters(const std::shared_ptr<NewtonProblem>& problem) {
  auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set("Nonlinear Solver", "Line Search Based");
  Teuchos::ParameterList& search = list->sublist("Line Search");
  search.set("Method", problem->settings.backtrack ? "User Defined" : "Full Step");
  if (problem->settings.backtrack) {
    search.set<Teuchos::RCP<NOX::LineSearch::UserDefinedFactory>>(
        "User Defined Line Search Factory", Teuchos::rcp(new LateSearchFactory(problem)));
  }
  list->sublist("Direction").set("Method", "Newton");
  // a failed linear solve leaves no direction; NOX would go on with what it finds
  list->sublist("Direction").sublist("Newton").set("Rescue Bad Newton Solve", false);
  Teuchos::ParameterList& printing = list->sublist("Printing");
  printing.set("Output Information", 0);
  // NOX reports what fails whatever it was told; our outcome says it, and the streams are the
  // caller's
  const Teuchos::RCP<std::ostream> nowhere = Teuchos::rcp(new Teuchos::oblackholestream);
  printing.set("Output Stream", nowhere);
  printing.set("Error Stream", nowhere);
  return list;
}

}  // namespace

struct NewtonSolver::Nox {
  // What an attempt changes and the next one reads.
  struct Kept {
    int expected_iterations = 0;
    bool has_factors = false;
    double factored_inertia = 0.0;
    long factorisations = 0;
  };

  std::shared_ptr<NewtonProblem> problem;
  Kept kept;
  Snapshot kept_matrix = Snapshot(Snapshot::Use::memory);  // of the factors that serve on
  Teuchos::RCP<NewtonGroup> group;
  Teuchos::RCP<BalanceTest> balance;
  Teuchos::RCP<NOX::StatusTest::Combo> tests;
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
      return "an element turned beyond its range, a law left its domain, or what is in contact "
             "would "
             "pass through";
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
  nox_->problem->tangent_is_whole = has_whole_tangent(system.model());
  nox_->problem->creeps = has_partial_tangent(system.model());
  nox_->group = Teuchos::rcp(new NewtonGroup(nox_->problem));
  nox_->balance = Teuchos::rcp(new BalanceTest(*nox_->problem));
  nox_->tests = Teuchos::rcp(new NOX::StatusTest::Combo(NOX::StatusTest::Combo::OR));
  nox_->tests->addStatusTest(nox_->balance);
  nox_->tests->addStatusTest(Teuchos::rcp(new NOX::StatusTest::MaxIters(settings.max_iterations)));
  nox_->solver = NOX::Solver::buildSolver(nox_->group, nox_->tests, nox_parameters(nox_->problem));
}

NewtonSolver::~NewtonSolver() = default;

StepOutcome NewtonSolver::solve(model::State& state, const Stencil& stencil,
                                LevelCondition* condition) {
  Nox& nox = *nox_;
  nox.problem->state = &state;
  nox.problem->stencil = stencil;
  nox.problem->condition = condition;
  const assembly::Rows& system_rows = nox.problem->system.layout().rows();
  if (condition != nullptr && !nox.problem->level_gradient) {
    nox.problem->level_gradient.emplace(system_rows);
    nox.problem->level_flexibility.emplace(system_rows);
  }
  nox.problem->first_determinant = {};
  nox.problem->singular = nox.problem->not_finite = false;
  nox.problem->largest_increment = nox.problem->last_residual = 0.0;
  nox.problem->iterations = 0;
  nox.balance->reset();
  nox.group->start();

  NOX::StatusTest::StatusType status = NOX::StatusTest::Failed;
  try {
    // NOX throws when the residual fails at the start of a step; that is an outcome, not an error
    if (nox.group->computeF() == NOX::Abstract::Group::Ok) {
      nox.solver->reset(nox.group->getX());
      status = nox.solver->solve();
    }
  } catch (const char*) {
    // how NOX ends when there is no Newton direction; find_end knows the reason
  } catch (...) {
    nox.group->finish();
    throw;
  }
  nox.group->finish();
  StepOutcome outcome;
  outcome.end = nox.find_end(status, *nox.group);
  outcome.history = nox.balance->history();
  outcome.iterations = std::max(0, static_cast<int>(outcome.history.size()) - 1);
  outcome.last = nox.group->evaluation();
  if (outcome.converged()) outcome.held_unknown = nox.balance->held_unknown();
  outcome.first_determinant = nox.problem->first_determinant;
  if (outcome.first_determinant.sign != 0 && outcome.converged()) {
    outcome.last_determinant = nox.problem->linear.determinant();
  }
  if (!outcome.converged()) nox.problem->has_factors = false;
  nox.problem->expected_iterations = outcome.converged() ? outcome.iterations : 0;
  return outcome;
}

void NewtonSolver::hold_free(bool holds) { nox_->problem->holds_free = holds; }

void NewtonSolver::keep() {
  const NewtonProblem& p = *nox_->problem;
  p.linear.remember_pivots();
  const bool is_new = p.factorisations != nox_->kept.factorisations;
  nox_->kept = {p.expected_iterations, p.has_factors, p.factored_inertia, p.factorisations};
  // the matrix has not changed since it was factored
  if (p.settings.refresh == Refresh::on_slow_convergence && p.has_factors && is_new) {
    p.system.save_matrix(nox_->kept_matrix);
  }
}

void NewtonSolver::go_back() {
  NewtonProblem& p = *nox_->problem;
  const bool is_new = p.factorisations != nox_->kept.factorisations;
  p.expected_iterations = nox_->kept.expected_iterations;
  p.linear.restore_pivots();
  if (p.settings.refresh == Refresh::every_iteration || !is_new) return;
  p.factored_inertia = nox_->kept.factored_inertia;
  p.has_factors =
      nox_->kept.has_factors && p.system.restore_matrix(nox_->kept_matrix) && p.linear.factor();
  nox_->kept.factorisations = p.factorisations;
}

void NewtonSolver::save(Snapshot& snapshot) const {
  const NewtonProblem& p = *nox_->problem;
  const std::vector<int> pivots = p.linear.pivots();
  snapshot.set("newton/pivots", {pivots.begin(), pivots.end()});
  snapshot.set("newton/expected iterations", p.expected_iterations);
  if (p.settings.refresh == Refresh::every_iteration || !p.has_factors) return;
  // the matrix has not changed since it was factored
  snapshot.set("newton/inertia", p.factored_inertia);
  p.system.save_matrix(snapshot);
}

void NewtonSolver::restore(const Snapshot& snapshot) {
  NewtonProblem& p = *nox_->problem;
  p.expected_iterations = snapshot.integer("newton/expected iterations");
  p.has_factors = false;  // those of now belong to another state
  const std::span<const double> kept = snapshot.numbers("newton/pivots");
  // where they do not fit, the solver begins anew
  p.linear.set_pivots(std::vector<int>(kept.begin(), kept.end()));
  if (p.settings.refresh != Refresh::every_iteration && snapshot.has("newton/inertia")) {
    p.factored_inertia = snapshot.number("newton/inertia");
    p.has_factors = p.system.restore_matrix(snapshot) && p.linear.factor();
    ++p.factorisations;
  }
  keep();  // the first attempt may be discarded
}

}  // namespace culm::solver
