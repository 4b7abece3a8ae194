// What a Newton iteration of a shell costs, part by part: a plate of n x n elements clamped along
// one side and bent by forces on the other. Times are of the CPU. Counter s/element is that of an
// iteration over all elements, MB the memory that the factors hold.

#include <culm/load/slot_load.hpp>
#include <culm/material/isotropic.hpp>
#include <culm/model/model.hpp>
#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/element_batches.hpp>
#include <culm/solver/newton_solver.hpp>

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <memory>
#include <string>

namespace {

using namespace culm;
using shell::ElasticShell;

model::NodeSlots node_at(double x, double y) {
  model::NodeSlots slots = model::NodeSlots::Zero();
  slots.col(0) = Vec3(x, y, 0.0);
  slots.col(1) = Vec3::UnitZ();
  return slots;
}

double held_megabytes() {
  const auto info = mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

/// A plate of side 1 with all that is needed to solve it.
class Plate {
 public:
  Plate(int n, int layers, const std::string& linear_solver) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        model.nodes().add(node_at(static_cast<double>(i) / n, static_cast<double>(j) / n),
                          NodeKind::node6);
      }
    }
    material::Layup wall;
    for (int l = 0; l < layers; ++l) {
      wall.layers.push_back(
          {material::Material{material::IsotropicMaterial::law(1e7, 0.3)}, 0.01 / layers, 0.3 * l});
    }
    const auto layup = std::make_shared<const material::Layup>(wall);
    auto& batch = model::elements<ElasticShell>(model, "Shell");
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int first = j * (n + 1) + i;
        const std::array<int, 4> nodes{first, first + 1, first + n + 2, first + n + 1};
        shell::ShellForms::Nodes reference;
        for (int a = 0; a < 4; ++a) {
          const model::NodeSlots slots = model::NodeTable::slots(
              model.nodes().reference(), nodes[static_cast<std::size_t>(a)]);
          reference.middleCols<2>(2 * a) = slots.leftCols<2>();
        }
        batch.add(ElasticShell(reference, layup), nodes);
      }
    }
    auto load = std::make_unique<load::SlotLoad>("Force", model.nodes(), model::Amplitude::ramp());
    for (int j = 0; j <= n; ++j) {
      model.add_constraint(clamp(j * (n + 1)));
      load->add_force(model::marker_at(j * (n + 1) + n), Vec3(0.0, 0.0, 0.3 / (n + 1)),
                      load::Axes::space);
    }
    model.add_load(std::move(load));
    model.freeze(model::Form::null_space);
    system = std::make_unique<assembly::System>(model, comm, ledger);
    const double before = held_megabytes();
    linear = solver::choose_linear_solver(linear_solver, system->matrix(), comm).solver;
    newton =
        std::make_unique<solver::NewtonSolver>(*system, *linear, solver::NewtonSettings{}, ledger);
    state = model.initial_state();
    state.time = 1.0;
    system->prepare(state, Stencil::statics());
    system->choose_multiplier_scale(state, Stencil::statics());
    system->evaluate(state, Stencil::statics(), Want::residual_and_tangent);
    linear->factor();
    megabytes = held_megabytes() - before;
  }

  model::Constraint clamp(int node) const {
    model::Constraint c;
    c.type = "Rigid Support";
    c.nodes = {node};
    c.fix = model::Constraint::Fix{node, std::bitset<6>("111111")};
    const Eigen::Matrix3Xd q = model::NodeTable::slots(model.nodes().reference(), node);
    for (std::size_t s = 0; s < 2; ++s) {
      model::SlotSum alpha(4, 0.0);
      alpha[s] = 1.0;
      for (int i = 0; i < 3; ++i) {
        c.rows.push_back(model::linear_row(Vec3::Unit(i), alpha, q));
      }
    }
    return c;
  }

  parallel::Comm comm;
  Ledger ledger;
  model::Model model;
  std::unique_ptr<assembly::System> system;
  std::unique_ptr<solver::LinearSolver> linear;
  std::unique_ptr<solver::NewtonSolver> newton;
  model::State state;
  double megabytes = 0.0;
};

double elements(const benchmark::State& run) {
  return static_cast<double>(run.range(0) * run.range(0));
}

void Plate_Assembly(benchmark::State& run) {
  Plate plate(static_cast<int>(run.range(0)), static_cast<int>(run.range(1)), "KLU2");
  for (auto _ : run) {
    benchmark::DoNotOptimize(
        plate.system->evaluate(plate.state, Stencil::statics(), Want::residual_and_tangent));
  }
  run.counters["s/element"] = benchmark::Counter(
      elements(run), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void Plate_Factorisation(benchmark::State& run, const char* name) {
  Plate plate(static_cast<int>(run.range(0)), 1, name);
  run.counters["MB"] = plate.megabytes;
  for (auto _ : run) benchmark::DoNotOptimize(plate.linear->factor());
}

void Plate_Solution(benchmark::State& run, const char* name) {
  Plate plate(static_cast<int>(run.range(0)), 1, name);
  assembly::Vector x(plate.system->residual().rows());
  for (auto _ : run) benchmark::DoNotOptimize(plate.linear->solve(plate.system->residual(), x));
}

// A whole load step, NOX included; s/iteration is what an iteration takes of it.
void Plate_LoadStep(benchmark::State& run, const char* name) {
  Plate plate(static_cast<int>(run.range(0)), 1, name);
  const model::State start = plate.state;
  double iterations = 0.0;
  for (auto _ : run) {
    plate.state = start;
    plate.system->prepare(plate.state, Stencil::statics());
    const solver::StepOutcome outcome = plate.newton->solve(plate.state, Stencil::statics());
    if (!outcome.converged()) run.SkipWithError("the step did not converge");
    iterations += outcome.iterations;
  }
  run.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
  run.counters["s/iteration"] =
      benchmark::Counter(iterations, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(Plate_Assembly)->ArgsProduct({{20, 50, 100}, {1, 4, 20}});
#define CULM_EACH_SOLVER(function)                                       \
  BENCHMARK_CAPTURE(function, KLU2, "KLU2")->Arg(20)->Arg(50)->Arg(100); \
  BENCHMARK_CAPTURE(function, MUMPS, "MUMPS")->Arg(20)->Arg(50)->Arg(100)
CULM_EACH_SOLVER(Plate_Factorisation);
CULM_EACH_SOLVER(Plate_Solution);
CULM_EACH_SOLVER(Plate_LoadStep);

}  // namespace
