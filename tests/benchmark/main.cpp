#include <culm/simulation/session.hpp>

#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  const culm::simulation::Session session(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
