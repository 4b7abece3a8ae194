// Nanoseconds per vortex segment and point on one core: the kernel of the lattice. The goal is 15.

#include <culm/lattice/biot_savart.hpp>

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace {

using namespace culm;
using lattice::Points;
using lattice::Segments;

Points somewhere(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({uniform(random), uniform(random), uniform(random)});
  }
  return points;
}

Segments segments(std::size_t count) {
  return {somewhere(count, 1), somewhere(count, 2), std::vector<double>(count, 0.01)};
}

void set_time_per_pair(benchmark::State& state, std::size_t segments, std::size_t points) {
  state.counters["per_pair"] = benchmark::Counter(
      static_cast<double>(segments * points),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void biot_savart_sum(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const Segments vortices = segments(count);
  const Points points = somewhere(count, 3);
  const std::vector<double> strengths(count, 1.0);
  Points velocities(count);
  for (auto _ : state) {
    lattice::add_velocities(vortices, strengths, points, velocities);
    benchmark::DoNotOptimize(velocities.x.data());
  }
  set_time_per_pair(state, count, count);
}
BENCHMARK(biot_savart_sum)->Arg(64)->Arg(512)->Arg(4096)->Unit(benchmark::kMicrosecond);

void biot_savart_influence(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const Segments vortices = segments(count);
  const Points points = somewhere(count, 3), normals = somewhere(count, 4);
  std::vector<double> sums(count, 0.0);
  for (auto _ : state) {
    for (std::size_t s = 0; s < count; ++s) {
      lattice::add_normal_velocities(vortices, s, 1.0, points, normals, sums);
    }
    benchmark::DoNotOptimize(sums.data());
  }
  set_time_per_pair(state, count, count);
}
BENCHMARK(biot_savart_influence)->Arg(64)->Arg(512)->Unit(benchmark::kMicrosecond);

}  // namespace
