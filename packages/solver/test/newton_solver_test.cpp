#include <culm/base/error.hpp>
#include <culm/solver/newton_solver.hpp>

#include <culm_kit/chain_model.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace culm::solver {
namespace {

// A chain whose far end is carried to a place by a constraint, or by several that say the same.
class CarriedChain {
 public:
  CarriedChain(model::Form form, double distance, const NewtonSettings& settings, int carriers = 1,
               const std::string& solver = "Automatic") {
    kit::add_chain(model, 6);
    model.add_constraint(kit::clamp(model, 0));
    model::Constraint carried = kit::pin(model, 6);
    carried.fix.reset();
    carried.rows[2].constant += distance;
    for (int i = 0; i < carriers; ++i) model.add_constraint(carried);
    model.keep_redundant_rows();  // they make the matrix singular
    model.freeze(form);
    system = std::make_unique<assembly::System>(model, comm, ledger);
    linear = choose_linear_solver(solver, system->matrix(), comm).solver;
    newton = std::make_unique<NewtonSolver>(*system, *linear, settings, ledger);
    state = model.initial_state();
    system->prepare(state, Stencil::statics());
    system->choose_multiplier_scale(state, Stencil::statics());
  }
  StepOutcome solve() {
    const StepOutcome outcome = newton->solve(state, Stencil::statics());
    system->synchronise(state);
    return outcome;
  }

  parallel::Comm comm;
  Ledger ledger;
  model::Model model;
  std::unique_ptr<assembly::System> system;
  std::unique_ptr<LinearSolver> linear;
  std::unique_ptr<NewtonSolver> newton;
  model::State state;
};

TEST(NewtonSolver, ConvergesQuadratically) {
  NewtonSettings settings;
  settings.extrapolate_stress = false;
  CarriedChain chain(model::Form::null_space, 0.5, settings);
  const StepOutcome outcome = chain.solve();
  ASSERT_TRUE(outcome.converged());
  // the last three residuals above round-off: r_next < C r^2 with a moderate C
  const auto& history = outcome.history;
  const std::size_t last = history.size() - 1;
  EXPECT_LT(history[last].force, 100.0 * history[last - 1].force * history[last - 1].force + 1e-10);
  EXPECT_NEAR(model::NodeTable::slots(chain.state.next, 6)(2, 0), 0.6 + 0.5, 1e-10);
}

TEST(NewtonSolver, StressExtrapolationChangesThePathButNotTheSolution) {
  NewtonSettings plain;
  plain.extrapolate_stress = false;
  CarriedChain a(model::Form::null_space, 0.3, plain);
  CarriedChain b(model::Form::null_space, 0.3, NewtonSettings{});
  ASSERT_TRUE(a.solve().converged());
  ASSERT_TRUE(b.solve().converged());
  for (std::size_t i = 0; i < a.state.next.size(); ++i) {
    EXPECT_NEAR(a.state.next[i], b.state.next[i], 1e-9);
  }
}

TEST(NewtonSolver, OldFactorsGiveTheSameSolutionWithFewerFactorisations) {
  NewtonSettings modified;
  modified.refresh = Refresh::on_slow_convergence;
  CarriedChain a(model::Form::null_space, 0.1, NewtonSettings{});
  CarriedChain b(model::Form::null_space, 0.1, modified);
  const auto solve_twice = [](CarriedChain& chain) {
    EXPECT_TRUE(chain.solve().converged());
    chain.state.next[48] += 1e-4;  // a node of the chain, pushed off its equilibrium
    EXPECT_TRUE(chain.solve().converged());
    for (const Ledger::Entry& entry : chain.ledger.entries()) {
      if (entry.name == "Factorisation, " + chain.linear->name()) return entry.calls;
    }
    return -1LL;
  };
  const long long full = solve_twice(a);
  const long long few = solve_twice(b);
  EXPECT_LT(few, full);
  for (std::size_t i = 0; i < a.state.next.size(); ++i) {
    EXPECT_NEAR(a.state.next[i], b.state.next[i], 1e-9);
  }
}

TEST(NewtonSolver, LinearSolversLeadToTheSameSolution) {
  for (model::Form form : {model::Form::null_space, model::Form::multipliers}) {
    CarriedChain a(form, 0.3, NewtonSettings{}, 1, "KLU2");
    CarriedChain b(form, 0.3, NewtonSettings{}, 1, "MUMPS");
    ASSERT_TRUE(a.solve().converged());
    ASSERT_TRUE(b.solve().converged());
    for (std::size_t i = 0; i < a.state.next.size(); ++i) {
      EXPECT_NEAR(a.state.next[i], b.state.next[i], 1e-9);
    }
  }
}

TEST(NewtonSolver, BothFormsHaveTheSameSolution) {
  CarriedChain a(model::Form::null_space, 0.3, NewtonSettings{});
  CarriedChain b(model::Form::multipliers, 0.3, NewtonSettings{});
  ASSERT_TRUE(a.solve().converged());
  ASSERT_TRUE(b.solve().converged());
  for (std::size_t i = 0; i < a.state.next.size(); ++i) {
    EXPECT_NEAR(a.state.next[i], b.state.next[i], 1e-9);
  }
  for (int node = 0; node <= 6; node += 6) {
    EXPECT_LT((a.system->reaction(node, a.state) - b.system->reaction(node, b.state)).norm(), 1e-7);
  }
}

TEST(NewtonSolver, ReactionsOfAnUnloadedStructureAreInBalance) {
  CarriedChain chain(model::Form::null_space, 0.4, NewtonSettings{});
  ASSERT_TRUE(chain.solve().converged());
  const Vec6 root = chain.system->reaction(0, chain.state);
  const Vec6 tip = chain.system->reaction(6, chain.state);
  const Vec3 arm = model::NodeTable::slots(chain.state.next, 6).col(0) -
                   model::NodeTable::slots(chain.state.next, 0).col(0);
  ASSERT_GT(tip.head<3>().norm(), 1.0);
  EXPECT_LT((root + tip).head<3>().norm(), 1e-9);
  const Vec3 tip_force = tip.head<3>();
  const Vec3 moment = root.tail<3>() + tip.tail<3>() + skew(arm) * tip_force;
  EXPECT_LT(moment.norm(), 1e-8);
}

TEST(NewtonSolver, RoundingIsNamedWhereItHoldsForcesAboveTheTolerance) {
  NewtonSettings settings;
  CarriedChain met(model::Form::null_space, 0.3, settings);
  const StepOutcome outcome = met.solve();
  ASSERT_TRUE(outcome.converged());
  EXPECT_LE(outcome.history.back().force, settings.force_tolerance);
  EXPECT_FALSE(outcome.held_unknown);

  settings.force_tolerance = 1e-18;
  CarriedChain beyond(model::Form::null_space, 0.3, settings);
  const StepOutcome held = beyond.solve();
  ASSERT_TRUE(held.converged());
  EXPECT_LT(held.history.back().force, 1e-13);
  ASSERT_TRUE(held.held_unknown);
  const auto& residual = beyond.system->residual();
  const double largest = residual.largest();
  const auto row = residual.rows().local(*held.held_unknown);
  const double here = row ? std::abs(residual.values()[*row]) : 0.0;
  EXPECT_EQ(beyond.comm.max(here), largest);
}

TEST(NewtonSolver, OldFactorsAreRenewedBeforeRoundingIsBlamed) {
  NewtonSettings settings;
  settings.refresh = Refresh::on_slow_convergence;
  settings.force_tolerance = 1e-18;
  CarriedChain chain(model::Form::null_space, 0.3, settings);
  const StepOutcome held = chain.solve();
  ASSERT_TRUE(held.converged());
  EXPECT_TRUE(held.held_unknown);
  EXPECT_LT(held.history.back().force, 1e-13);
}

TEST(NewtonSolver, LineSearchLeavesIterationsAloneThatNeedNone) {
  NewtonSettings full;
  NewtonSettings backtrack;
  backtrack.backtrack = true;
  CarriedChain a(model::Form::null_space, 0.5, full);
  CarriedChain b(model::Form::null_space, 0.5, backtrack);
  const StepOutcome outcome = a.solve();
  ASSERT_TRUE(outcome.converged());
  ASSERT_LE(outcome.iterations, 6);
  EXPECT_EQ(b.solve().iterations, outcome.iterations);
  EXPECT_TRUE(std::ranges::equal(a.state.next, b.state.next));
}

TEST(NewtonSolver, FailureIsAValueWithAReason) {
  NewtonSettings settings;
  settings.max_iterations = 2;
  CarriedChain chain(model::Form::null_space, 0.5, settings);
  const StepOutcome outcome = chain.solve();
  EXPECT_EQ(outcome.end, StepEnd::too_many_iterations);
  EXPECT_EQ(outcome.iterations, 2);
}

TEST(NewtonSolver, RedundantConstraintsEndAStepWithoutAnException) {
  for (const char* solver : {"KLU2", "MUMPS"}) {
    CarriedChain chain(model::Form::multipliers, 0.1, NewtonSettings{}, 2, solver);
    EXPECT_EQ(chain.solve().end, StepEnd::singular) << solver;
  }
}

// One that ends with an error instead of factors, after so many of them.
class EndingSolver final : public LinearSolver {
 public:
  EndingSolver(LinearSolver& solver, int factorisations) : solver_(solver), left_(factorisations) {}

  std::string name() const override { return solver_.name(); }
  bool factor() override {
    if (left_-- == 0) throw NumericalError("no memory for factors");
    return solver_.factor();
  }
  LinearResidual solve(const Vector& b, Vector& x) override { return solver_.solve(b, x); }
  Determinant determinant() override { return solver_.determinant(); }
  double weakest_direction(Vector& v) override { return solver_.weakest_direction(v); }

 private:
  LinearSolver& solver_;
  int left_;
};

TEST(NewtonSolver, ErrorsLeaveTheStateWithTheLastTrial) {
  for (const int factorisations : {0, 1}) {
    CarriedChain chain(model::Form::null_space, 0.5, NewtonSettings{});
    EndingSolver ending(*chain.linear, factorisations);
    NewtonSolver newton(*chain.system, ending, NewtonSettings{}, chain.ledger);
    const model::Coordinates start = chain.state.next;
    EXPECT_THROW(newton.solve(chain.state, Stencil::statics()), NumericalError);
    ASSERT_EQ(chain.state.next.size(), start.size());
    EXPECT_EQ(std::ranges::equal(chain.state.next, start), factorisations == 0);
    // and nothing of it stays
    chain.state.next = start;
    EXPECT_TRUE(chain.solve().converged());
  }
}

TEST(NewtonSolver, NumbersThatAreNotFiniteStopInTheSameIteration) {
  CarriedChain chain(model::Form::null_space, 0.1, NewtonSettings{});
  chain.state.next[40] = std::numeric_limits<double>::quiet_NaN();
  const StepOutcome outcome = chain.solve();
  EXPECT_EQ(outcome.end, StepEnd::not_finite);
  EXPECT_EQ(outcome.iterations, 0);
}

}  // namespace
}  // namespace culm::solver
