// A rotor of three blades, 8 x 24 panels each, with wakes of 200 rows: what comes once per step,
// with a prescribed and with a free wake, and what comes in each iteration.

#include <culm/lattice/lattice.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace {

using namespace culm;
using namespace culm::lattice;

class Wind final : public flow::Flow {
 public:
  Wind() : Flow(1.225) {}
  void velocities(std::span<const Vec3>, double, std::span<Vec3> out) const override {
    std::fill(out.begin(), out.end(), Vec3(10.0, 0.0, 0.0));
  }
};

constexpr Panels panels{8, 24};
constexpr int blades = 3, rows = 200;
constexpr double step = 0.02, speed = 1.2;  // [s, rad/s]

Points rotor(double time) {
  Points grid;
  for (int blade = 0; blade < blades; ++blade) {
    const double turn = speed * time + blade * 2.0 * std::numbers::pi / blades;
    const Vec3 along(0.0, std::cos(turn), std::sin(turn)),
        back(0.05, std::sin(turn), -std::cos(turn));
    for (int i = 0; i <= panels.chord; ++i) {
      for (int j = 0; j <= panels.span; ++j) {
        grid.push_back((5.0 + 55.0 * j / panels.span) * along + 3.0 * i / panels.chord * back);
      }
    }
  }
  return grid;
}

struct Turning {
  explicit Turning(WakeMotion motion)
      : lattice(BoundLattice(std::vector<Panels>(blades, panels), rotor(0.0), std::nullopt),
                std::make_shared<Wind>(), {.wake = motion, .rows = rows}),
        state(lattice.initial_state()),
        grid{rotor(0.0), rotor(step), Points(rotor(0.0).size()), 0.0, step} {
    // rows of a helix, as if shed by the turning rotor
    for (int row = 0; row < rows; ++row) {
      const BoundLattice& bound = lattice.bound();
      const Points edges = bound.edge_points(bound.corners(rotor(step * (row - rows))));
      Points wind(edges.size()), lines(state.wake.lines().size());
      std::fill(wind.x.begin(), wind.x.end(), 10.0);
      std::fill(lines.x.begin(), lines.x.end(), 10.0);
      state.wake.advance(step, edges, wind, lines, std::vector<double>(bound.num_strips(), 1.0));
    }
  }

  Lattice lattice;
  FluidState state;
  GridStep grid;
};

void lattice_once_per_step(benchmark::State& state) {
  const Turning rotor(state.range(0) == 0 ? WakeMotion::prescribed : WakeMotion::free);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        rotor.lattice.begin_step(rotor.state, rotor.grid.start, rotor.grid.end, 0.0, step));
  }
}
BENCHMARK(lattice_once_per_step)->ArgName("free")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void lattice_per_iteration(benchmark::State& state) {
  const Turning rotor(WakeMotion::prescribed);
  const auto coming =
      rotor.lattice.begin_step(rotor.state, rotor.grid.start, rotor.grid.end, 0.0, step);
  for (auto _ : state) {
    benchmark::DoNotOptimize(rotor.lattice.step(rotor.state, coming, rotor.grid));
  }
}
BENCHMARK(lattice_per_iteration)->Unit(benchmark::kMillisecond);

}  // namespace
