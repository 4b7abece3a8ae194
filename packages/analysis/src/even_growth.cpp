#include "even_growth.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace culm::analysis {
namespace {

// Of the way; kinks are seldom there, and curves that are symmetric about its middle are off.
constexpr double share_of_way = 0.3;

// Of the change; what prescribed turns of some degrees are off is less.
constexpr double noticeable_bend = 1e-2;

// Forces, and tangents, which see loads that stress the structure without moving it, as heat does.
struct Loaded {
  double size = 0.0;  // of the forces of elements and loads, which may cancel
  std::vector<double> forces;
  std::vector<double> tangent;
};

Loaded loaded(assembly::System& system, model::State& at, double level) {
  const Stencil stencil = Stencil::statics();
  at.time = at.time_prev = level;
  system.prepare(at, stencil);
  const double size = system.evaluate(at, stencil, Want::residual_and_tangent).force_scale;
  const auto forces = system.residual().values();
  const auto tangent = system.matrix()->values();
  return {size, {forces.begin(), forces.end()}, {tangent.begin(), tangent.end()}};
}

// How far values are from those between, over how far both ends are apart, which must be more than
// rounding.
bool lie_between(const std::vector<double>& begin, const std::vector<double>& values,
                 const std::vector<double>& end, double size, const parallel::Comm& comm) {
  double change = 0.0;
  double off = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    size = std::max({size, std::abs(begin[k]), std::abs(end[k])});
    change = std::max(change, std::abs(end[k] - begin[k]));
    off = std::max(off, std::abs(values[k] - begin[k] - share_of_way * (end[k] - begin[k])));
  }
  size = comm.max(size);
  change = comm.max(change);
  off = comm.max(off);
  return off <= std::max(noticeable_bend * change, 1e-12 * size);
}

}  // namespace

bool grow_evenly(Context& context, model::State at, double level) {
  assembly::System& system = context.system;
  const double present = at.time;
  at.prev = at.next;
  const Loaded begin = loaded(system, at, present);
  const Loaded between = loaded(system, at, present + share_of_way * (level - present));
  const Loaded end = loaded(system, at, level);
  return lie_between(begin.forces, between.forces, end.forces, std::max(begin.size, end.size),
                     system.comm()) &&
         lie_between(begin.tangent, between.tangent, end.tangent, 0.0, system.comm());
}

}  // namespace culm::analysis
