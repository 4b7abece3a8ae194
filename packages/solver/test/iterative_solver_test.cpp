#include <culm/assembly/system.hpp>
#include <culm/base/error.hpp>
#include <culm/solver/linear_solver.hpp>

#include "../src/krylov.hpp"

#include <culm_kit/chain_model.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace culm::solver {
namespace {

// A square sheet of springs with n x n nodes; the equations of its tangent.
class Sheet {
 public:
  enum class Hold { edge, edge_and_equations, nothing };

  explicit Sheet(int n, Hold hold = Hold::edge) {
    model::Structure& structure = model.add_structure("sheet");
    auto& springs = model::elements<kit::SpringLink>(model, "Spring link");
    for (int i = 0; i < n * n; ++i) {
      model::NodeSlots slots = model::NodeSlots::Zero();
      slots.col(0) = Vec3(i % n, i / n, std::sin(0.2 * (i % n)));
      slots.rightCols<3>().setIdentity();
      structure.nodes.push_back(model.nodes().add(slots));
    }
    const auto link = [&](int a, int b) {
      Slots<8> reference;
      reference << model::NodeTable::slots(model.nodes().reference(), a),
          model::NodeTable::slots(model.nodes().reference(), b);
      springs.add(kit::SpringLink(reference, 100.0), {a, b});
    };
    for (int i = 0; i < n * n; ++i) {
      if (i % n + 1 < n) link(i, i + 1);
      if (i + n < n * n) link(i, i + n);
    }
    for (int i = 0; i < n && hold != Hold::nothing; ++i) {
      model.add_constraint(kit::clamp(model, i * n));
    }
    if (hold == Hold::edge_and_equations) {
      model::Constraint pin = kit::pin(model, n * n / 2 + 1);
      pin.fix.reset();  // multipliers, not unknowns less
      model.add_constraint(pin);
    }
    model.freeze(model::Form::null_space);
    system = std::make_unique<assembly::System>(model, comm, ledger);
    system->watch_tangents();
    state = model.initial_state();
    system->prepare(state, Stencil::statics());
    system->choose_multiplier_scale(state, Stencil::statics());
    system->evaluate(state, Stencil::statics(), Want::residual_and_tangent);
    matrix = std::make_shared<assembly::Matrix>(*system->matrix());
  }

  std::unique_ptr<LinearSolver> make(double memory = 1e12) const {
    return make_iterative(matrix, {[this] { return system->node_motions(); }, memory}, comm);
  }
  // A right-hand side without symmetry.
  Vector load() const {
    Vector b(system->layout().rows());
    for (std::size_t i = 0; i < b.rows().size(); ++i) {
      b.values()[i] = std::sin(1.0 + static_cast<double>(b.rows().global(i)));
    }
    return b;
  }
  // Adds to all entries of the diagonal.
  void shift(double by) const {
    std::size_t k = 0;
    matrix->each_entry([&](std::size_t row, long long column, double) {
      if (column == matrix->rows().global(row)) matrix->values()[k] += by;
      ++k;
    });
  }
  double difference_to_mumps(const Vector& b, const Vector& x) const {
    const auto direct = make_mumps(matrix, comm);
    Vector exact(b.rows());
    EXPECT_TRUE(direct->factor());
    EXPECT_TRUE(direct->solve(b, exact).is_sound());
    const double size = exact.largest();
    exact.update(1.0, x, -1.0);
    return exact.largest() / size;
  }

  parallel::Comm comm;
  Ledger ledger;
  model::Model model;
  std::unique_ptr<assembly::System> system;
  std::shared_ptr<assembly::Matrix> matrix;  // the tangent; tests change it
  model::State state;
};

TEST(NodeMotions, AreThoseThatNothingResists) {
  const Sheet sheet(6, Sheet::Hold::nothing);
  const assembly::NodeMotions motions = sheet.system->node_motions();
  for (int k = 0; k < 6; ++k) {
    Vector motion(sheet.system->layout().rows()), force(motion.rows());
    for (std::size_t i = 0; i < motion.rows().size(); ++i) {
      motion.values()[i] = motions.rigid(static_cast<Eigen::Index>(i), k);
    }
    sheet.matrix->multiply(motion, force);
    EXPECT_GT(motion.largest(), 0.5);
    EXPECT_LT(force.largest(), 1e-11 * sheet.matrix->norm());
  }
}

TEST(Iterative, SolvesAsMumpsDoes) {
  const Sheet sheet(24);
  const auto solver = sheet.make();
  ASSERT_TRUE(solver->factor());
  const Vector b = sheet.load();
  Vector x(b.rows());
  EXPECT_TRUE(solver->solve(b, x).is_sound());
  EXPECT_LT(sheet.difference_to_mumps(b, x), 1e-9);
  EXPECT_EQ(solver->remark().find("MUMPS"), std::string::npos);
  // new values, old grids
  sheet.shift(0.1);
  ASSERT_TRUE(solver->factor());
  EXPECT_TRUE(solver->solve(b, x).is_sound());
  EXPECT_LT(sheet.difference_to_mumps(b, x), 1e-9);
}

TEST(Iterative, GoesAsFarAsItIsAskedTo) {
  const Sheet sheet(24);
  const auto solver = sheet.make();
  ASSERT_TRUE(solver->factor());
  const Vector b = sheet.load();
  Vector x(b.rows()), rest(b.rows());
  for (const double reduction : {1e-2, 1e-5}) {
    EXPECT_TRUE(solver->solve_roughly(b, x, reduction).is_sound());
    sheet.matrix->multiply(x, rest);
    rest.update(1.0, b, -1.0);
    EXPECT_LT(rest.norm(), reduction * b.norm());
    EXPECT_GT(rest.norm(), 1e-4 * reduction * b.norm());
  }
}

TEST(Iterative, CountsHardlyGrowWithTheMesh) {
  const auto iterations = [](int n) {
    const Sheet sheet(n);
    Multigrid multigrid(assembly::tpetra(std::as_const(*sheet.matrix)),
                        sheet.system->node_motions(), std::numeric_limits<double>::infinity(),
                        sheet.comm);
    const Vector b = sheet.load();
    Vector x(b.rows());
    const KrylovEnd end = conjugate_gradients(multigrid, b, x, {1e-8, 200});
    EXPECT_TRUE(end.converged);
    return end.iterations;
  };
  const int coarse = iterations(16);
  EXPECT_LT(coarse, 40);
  EXPECT_LT(iterations(48), 1.5 * coarse + 4);
}

TEST(Iterative, KeepsMultipliersForTheDirectSolver) {
  const Sheet sheet(16, Sheet::Hold::edge_and_equations);
  ASSERT_GT(sheet.model.unknowns().num_multipliers(), 0);
  const auto solver = sheet.make();
  ASSERT_TRUE(solver->factor());
  const Vector b = sheet.load();
  Vector x(b.rows());
  EXPECT_TRUE(solver->solve(b, x).is_sound());
  EXPECT_LT(sheet.difference_to_mumps(b, x), 1e-9);
  EXPECT_EQ(solver->remark().find("MUMPS"), std::string::npos);
}

TEST(Iterative, SolvesBeyondALimitPoint) {
  const Sheet sheet(16);
  sheet.shift(-0.5);  // below the lowest eigenvalues
  const auto direct = make_mumps(sheet.matrix, sheet.comm);
  const auto solver = sheet.make();
  ASSERT_TRUE(solver->factor());
  const Vector b = sheet.load();
  Vector x(b.rows());
  EXPECT_TRUE(solver->solve(b, x).is_sound());
  EXPECT_LT(sheet.difference_to_mumps(b, x), 1e-8);
  EXPECT_EQ(solver->determinant().sign, 0);
}

TEST(Iterative, FindsWhatNothingHolds) {
  const Sheet sheet(12, Sheet::Hold::nothing);
  const auto solver = sheet.make();
  const bool regular = solver->factor();
  Vector b = sheet.load(), x(b.rows());
  // as with a direct solver rounding may leave an inverse, whose solutions are beyond all bounds
  if (regular && solver->solve(b, x).is_sound()) {
    EXPECT_GT(x.largest() * sheet.matrix->norm(), 1e12 * b.largest());
  }
  const double ratio = solver->weakest_direction(x);
  EXPECT_LT(ratio, 1e-12);
  EXPECT_NEAR(x.largest(), 1.0, 1e-12);
}

TEST(Iterative, LeavesToMumpsWhatDoesNotConverge) {
  const Sheet sheet(16);
  // no structure has such a stiffness
  const auto values = sheet.matrix->values();
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] = std::sin(1.0 + 7.0 * static_cast<double>(k * k % 1009));
  }
  const Vector b = sheet.load();
  Vector x(b.rows());
  const auto solver = sheet.make();
  if (solver->factor()) {
    EXPECT_TRUE(solver->solve(b, x).is_sound());
    EXPECT_LT(sheet.difference_to_mumps(b, x), 1e-6);
    if (sheet.comm.is_root()) {
      EXPECT_NE(solver->remark().find("by MUMPS"), std::string::npos);
    }
  }
  const auto poor = sheet.make(1.0);
  if (poor->factor()) {
    EXPECT_THROW(poor->solve(b, x), NumericalError);
  }
}

}  // namespace
}  // namespace culm::solver
