// Factorisation of matrices like those of shells, Block LU and KLU2 against MUMPS: n x n nodes with
// six unknowns each, coupled with their eight neighbours. Chains of nodes, like beams, show the
// other side: what a Newton iteration pays for each node, KLU2 with kept pivots.
// Counters: front, the figure by which 'Automatic' decides, and MB, the memory that the factors
// hold. Under mpiexec all ranks take part.

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/solver/fill.hpp>
#include <culm/solver/linear_solver.hpp>

#include <Teuchos_DefaultMpiComm.hpp>
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cmath>
#include <memory>

namespace {

using namespace culm;
using assembly::CrsMatrix;
using assembly::GlobalIndex;
using assembly::Map;

constexpr int unknowns = 6;

parallel::Graph sheet(int width, int length) {
  parallel::Graph graph;
  for (int v = 0; v < width * length; ++v) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = v % width + dx;
        const int y = v / width + dy;
        if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= width || y >= length) continue;
        graph.neighbours.push_back(y * width + x);
      }
    }
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
    graph.weights.push_back(unknowns);
  }
  return graph;
}

// Unsymmetric values, with a diagonal that keeps the condition moderate.
std::shared_ptr<const assembly::Matrix> fill_matrix(const parallel::Graph& graph,
                                                    const parallel::Comm& comm) {
  const std::vector<int> owner = parallel::partition(graph, comm.size());
  std::vector<GlobalIndex> rows;
  for (int v = 0; v < graph.size(); ++v) {
    if (owner[static_cast<std::size_t>(v)] != comm.rank()) continue;
    for (int i = 0; i < unknowns; ++i) rows.push_back(unknowns * v + i);
  }
  const auto mpi = Teuchos::rcp(new Teuchos::MpiComm<int>(comm.handle()));
  const auto total = static_cast<Tpetra::global_size_t>(unknowns * graph.size());
  const auto map = comm.size() == 1
                       ? Teuchos::rcp(new Map(total, 0, mpi))
                       : Teuchos::rcp(new Map(total, Teuchos::arrayViewFromVector(rows), 0, mpi));
  const auto matrix = Teuchos::rcp(new CrsMatrix(map, 9 * unknowns));
  for (GlobalIndex row : rows) {
    const auto v = static_cast<std::size_t>(row / unknowns);
    std::vector<GlobalIndex> columns;
    std::vector<double> values;
    const auto couple = [&](int other) {
      for (int j = 0; j < unknowns; ++j) {
        columns.push_back(unknowns * other + j);
        values.push_back(std::sin(static_cast<double>(3 * row - 2 * columns.back())));
        if (columns.back() == row) values.back() += 20.0;
      }
    };
    couple(static_cast<int>(v));
    for (int e = graph.begin[v]; e < graph.begin[v + 1]; ++e) {
      couple(graph.neighbours[static_cast<std::size_t>(e)]);
    }
    matrix->insertGlobalValues(row, Teuchos::arrayViewFromVector(columns),
                               Teuchos::arrayViewFromVector(values));
  }
  matrix->fillComplete();
  return assembly::matrix_of(matrix);
}

double held_megabytes(const parallel::Comm& comm) {
  const auto info = mallinfo2();
  return 1e-6 * comm.sum(static_cast<double>(info.uordblks + info.hblkhd));
}

// The first factorisation, with the analysis, is not counted.
void factorise(benchmark::State& run, const char* name, const parallel::Graph& graph) {
  const parallel::Comm comm;
  const auto matrix = fill_matrix(graph, comm);
  const double before = held_megabytes(comm);
  const auto solver = solver::choose_linear_solver(name, matrix, comm).solver;
  if (!solver->factor()) run.SkipWithError("singular");
  run.counters["MB"] = held_megabytes(comm) - before;
  run.counters["front"] = solver::predict_fill(graph, parallel::dissect(graph)).front();
  run.counters["unknowns"] = unknowns * graph.size();
  for (auto _ : run) benchmark::DoNotOptimize(solver->factor());
}

void Factorise_Sheet(benchmark::State& run, const char* name) {
  const auto n = static_cast<int>(run.range(0));
  factorise(run, name, sheet(n, n));
}

// As long as a beam of a thousand elements, and as wide as the argument says.
void Factorise_Strip(benchmark::State& run, const char* name) {
  factorise(run, name, sheet(static_cast<int>(run.range(0)), 1000));
}

void Solve_Sheet(benchmark::State& run, const char* name) {
  const parallel::Comm comm;
  const auto n = static_cast<int>(run.range(0));
  const auto matrix = fill_matrix(sheet(n, n), comm);
  const auto solver = solver::choose_linear_solver(name, matrix, comm).solver;
  assembly::Vector x(matrix->rows());
  assembly::Vector b(matrix->rows());
  b.fill(1.0);
  if (!solver->factor()) run.SkipWithError("singular");
  for (auto _ : run) benchmark::DoNotOptimize(run.counters["residual"] = solver->solve(b, x).size);
}

void FactoriseAndSolve_Chain(benchmark::State& run, const char* name) {
  const parallel::Comm comm;
  const auto nodes = static_cast<int>(run.range(0));
  const auto matrix = fill_matrix(sheet(1, nodes), comm);
  const auto solver = solver::choose_linear_solver(name, matrix, comm).solver;
  assembly::Vector x(matrix->rows());
  assembly::Vector b(matrix->rows());
  b.fill(1.0);
  if (!solver->factor()) run.SkipWithError("singular");
  for (auto _ : run) {
    benchmark::DoNotOptimize(solver->factor());
    benchmark::DoNotOptimize(run.counters["residual"] = solver->solve(b, x).size);
  }
  using benchmark::Counter;
  run.counters["s/node"] = Counter(nodes, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

#define CULM_EACH_SOLVER(function, ...)                                         \
  BENCHMARK_CAPTURE(function, BlockLU, "Block LU")->__VA_ARGS__->UseRealTime(); \
  BENCHMARK_CAPTURE(function, KLU2, "KLU2")->__VA_ARGS__->UseRealTime();        \
  BENCHMARK_CAPTURE(function, MUMPS, "MUMPS")->__VA_ARGS__->UseRealTime()
BENCHMARK_CAPTURE(FactoriseAndSolve_Chain, BlockLU, "Block LU")
    ->RangeMultiplier(10)
    ->Range(10, 10000);
BENCHMARK_CAPTURE(FactoriseAndSolve_Chain, KLU2, "KLU2")->RangeMultiplier(10)->Range(10, 10000);
CULM_EACH_SOLVER(Factorise_Strip, DenseRange(1, 6));
CULM_EACH_SOLVER(Factorise_Sheet, Arg(5)->Arg(8)->Arg(10)->Arg(14)->Arg(20)->Arg(50)->Arg(100));
BENCHMARK_CAPTURE(Factorise_Sheet, MUMPS, "MUMPS")->Arg(200)->UseRealTime();
CULM_EACH_SOLVER(Solve_Sheet, Arg(20)->Arg(50)->Arg(100));

}  // namespace
