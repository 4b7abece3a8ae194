// What a Newton iteration of a beam costs, part by part: a cantilever of N two-node elements bent
// by a tip force, null space against multipliers. Counter ns/element is the one to compare.

#include <culm/beam/director_beam.hpp>
#include <culm/beam/element_batches.hpp>
#include <culm/load/slot_load.hpp>
#include <culm/model/model.hpp>
#include <culm/solver/newton_solver.hpp>

#include <benchmark/benchmark.h>

#include <memory>

namespace {

using namespace culm;
using Beam = beam::DirectorBeam<1>;
using model::Form;

model::NodeSlots node_at(double x) {
  // the axis d3 along x
  model::NodeSlots slots = model::NodeSlots::Zero();
  slots.col(0) = Vec3(x, 0.0, 0.0);
  slots.col(1) = Vec3::UnitY();
  slots.col(2) = Vec3::UnitZ();
  slots.col(3) = Vec3::UnitX();
  return slots;
}

Beam make_beam(const model::NodeSlots& a, const model::NodeSlots& b) {
  Slots<8> reference;
  reference << a, b;
  Mat6 stiffness = Mat6::Zero();
  stiffness.diagonal() << 4e6, 4e6, 1e7, 8e3, 8e3, 7e3;
  const Mat3 mass = Vec3(10.0, 8e-3, 8e-3).asDiagonal();
  return Beam(reference, {stiffness}, {mass, mass});
}

/// A cantilever of length 10 with all that is needed to solve it.
class Cantilever {
 public:
  Cantilever(int elements, Form form) {
    const double h = 10.0 / elements;
    for (int i = 0; i <= elements; ++i) model.nodes().add(node_at(i * h));
    auto& batch = model::elements<Beam>(model, "Beam, director, order 1");
    for (int i = 0; i < elements; ++i) {
      batch.add(make_beam(node_at(i * h), node_at((i + 1) * h)), {i, i + 1});
    }
    model.add_constraint(clamp());
    auto load = std::make_unique<load::SlotLoad>("Force", model.nodes(), model::Amplitude::ramp());
    load->add_force(model::marker_at(elements), Vec3(0.0, 100.0, 20.0), load::Axes::space);
    model.add_load(std::move(load));
    model.freeze(form);
    system = std::make_unique<assembly::System>(model, comm, ledger);
    linear = solver::make_rooted_klu2(system->matrix(), comm);
    newton =
        std::make_unique<solver::NewtonSolver>(*system, *linear, solver::NewtonSettings{}, ledger);
    state = model.initial_state();
    state.time = 1.0;
    system->prepare(state, Stencil::statics());
    system->choose_multiplier_scale(state, Stencil::statics());
  }

  model::Constraint clamp() const {
    model::Constraint c;
    c.type = "Rigid Support";
    c.nodes = {0};
    c.fix = model::Constraint::Fix{0, std::bitset<6>("111111")};
    c.replaces_internal = 0;
    const Eigen::Matrix3Xd q = node_at(0.0);
    for (int s = 0; s < 4; ++s) {
      model::SlotSum alpha(4, 0.0);
      alpha[static_cast<std::size_t>(s)] = 1.0;
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
};

void per_element(benchmark::State& run, double count) {
  run.counters["s/element"] = benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void Element_Evaluate(benchmark::State& run) {
  const Beam beam = make_beam(node_at(0.0), node_at(0.1));
  Slots<8> q;
  q << node_at(0.0), node_at(0.11);
  Vec6 strain;
  Gradient<8, 6> gradient;
  SlotMatrix<8> curvature = SlotMatrix<8>::Zero();
  Response<6> response;
  for (auto _ : run) {
    beam.strain(0, q, strain);
    beam.gradient(0, q, gradient);
    beam.respond(0, strain, strain, Stencil::statics(), response);
    beam.add_curvature(0, response.stress, curvature);
    benchmark::DoNotOptimize(gradient.data());
    benchmark::DoNotOptimize(curvature.data());
    q(0, 4) += 1e-12;
  }
  per_element(run, 1.0);
}

void Assembly(benchmark::State& run, Form form) {
  Cantilever c(static_cast<int>(run.range(0)), form);
  for (auto _ : run) {
    benchmark::DoNotOptimize(
        c.system->evaluate(c.state, Stencil::statics(), Want::residual_and_tangent));
  }
  per_element(run, static_cast<double>(run.range(0)));
}

void Factorisation(benchmark::State& run, Form form) {
  Cantilever c(static_cast<int>(run.range(0)), form);
  c.system->evaluate(c.state, Stencil::statics(), Want::residual_and_tangent);
  for (auto _ : run) benchmark::DoNotOptimize(c.linear->factor());
  per_element(run, static_cast<double>(run.range(0)));
}

void Solution(benchmark::State& run, Form form) {
  Cantilever c(static_cast<int>(run.range(0)), form);
  c.system->evaluate(c.state, Stencil::statics(), Want::residual_and_tangent);
  c.linear->factor();
  assembly::Vector x(c.system->residual().rows());
  for (auto _ : run) benchmark::DoNotOptimize(c.linear->solve(c.system->residual(), x));
  per_element(run, static_cast<double>(run.range(0)));
}

// A whole load step, NOX included, over its number of iterations.
void NewtonIteration(benchmark::State& run, Form form) {
  Cantilever c(static_cast<int>(run.range(0)), form);
  const model::State start = c.state;
  double iterations = 0.0;
  for (auto _ : run) {
    c.state = start;
    c.system->prepare(c.state, Stencil::statics());
    const solver::StepOutcome outcome = c.newton->solve(c.state, Stencil::statics());
    if (!outcome.converged()) run.SkipWithError("the step did not converge");
    iterations += outcome.iterations;
  }
  run.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
  run.counters["s/element"] =
      benchmark::Counter(iterations * static_cast<double>(run.range(0)),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(Element_Evaluate);
#define CULM_BOTH_FORMS(function)                           \
  BENCHMARK_CAPTURE(function, null_space, Form::null_space) \
      ->RangeMultiplier(10)                                 \
      ->Range(10, 10000);                                   \
  BENCHMARK_CAPTURE(function, multipliers, Form::multipliers)->RangeMultiplier(10)->Range(10, 10000)
CULM_BOTH_FORMS(Assembly);
CULM_BOTH_FORMS(Factorisation);
CULM_BOTH_FORMS(Solution);
CULM_BOTH_FORMS(NewtonIteration);

}  // namespace
