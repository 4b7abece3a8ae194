#include <culm/analysis/linearisation.hpp>
#include <culm/assembly/rounding.hpp>
#include <culm/base/error.hpp>
#include <culm/solver/eigen_solver.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

using assembly::CrsMatrix;

// Want::mass borders the mass by the constraint Jacobian; it has no part in inertia.
void remove_border(const assembly::System& system, CrsMatrix& mass) {
  std::vector<bool> is_multiplier;  // by local column
  for (const assembly::Layout::LocalBlock& local : system.layout().local_blocks()) {
    const model::Block& block = system.model().unknowns().block(local.block);
    const auto end = static_cast<std::size_t>(local.first_column + block.shape.active);
    if (is_multiplier.size() < end) is_multiplier.resize(end, false);
    if (block.kind != model::BlockKind::multipliers) continue;
    for (auto i = static_cast<std::size_t>(local.first_column); i < end; ++i) {
      is_multiplier[i] = true;
    }
  }
  const auto matrix = mass.getLocalMatrixHost();
  for (std::size_t row = 0; row < static_cast<std::size_t>(matrix.numRows()); ++row) {
    for (auto k = matrix.graph.row_map(row); k < matrix.graph.row_map(row + 1); ++k) {
      const auto column = static_cast<std::size_t>(matrix.graph.entries(k));
      if (is_multiplier[row] || is_multiplier[column]) matrix.values(k) = 0.0;
    }
  }
}

// Velocities are differences of coordinates over the step, so the damping is what of the tangent
// falls as 1 / step. Everything else is the same to the last bit.
Teuchos::RCP<CrsMatrix> find_damping(assembly::System& system, const model::State& state) {
  Teuchos::RCP<CrsMatrix> damping;
  for (const double step : {1.0, 0.5}) {
    const Stencil stencil{step, 1.0, 1.0, 0.0};
    system.prepare(state, stencil);
    system.evaluate(state, stencil, Want::residual_and_tangent);
    const auto tangent = system.matrix()->getLocalMatrixHost().values;
    if (damping.is_null()) {
      damping = Teuchos::rcp(new CrsMatrix(*system.matrix(), Teuchos::Copy));
      continue;
    }
    const auto values = damping->getLocalMatrixHost().values;
    for (std::size_t k = 0; k < values.extent(0); ++k) values(k) = tangent(k) - values(k);
  }
  remove_border(system, *damping);
  const auto values = damping->getLocalMatrixHost().values;
  double largest = 0.0;
  for (std::size_t k = 0; k < values.extent(0); ++k) {
    largest = std::max(largest, std::abs(values(k)));
  }
  if (system.comm().max(largest) == 0.0) return Teuchos::null;
  return damping;
}

}  // namespace

Linearisation linearise(Context& context, const model::State& state) {
  assembly::System& system = context.system;
  const Stencil stencil = Stencil::statics();
  system.prepare(state, stencil);
  system.choose_multiplier_scale(state, stencil);
  const assembly::Evaluation found = system.evaluate(state, stencil, Want::residual_and_tangent);
  Linearisation linear;
  if (found.force_scale > 0.0) linear.residual = found.force_residual / found.force_scale;
  const double balanced = 1e-6 * found.force_scale;
  // what rounding may leave, with a margin for states that other programs or analyses found
  linear.is_equilibrium = found.force_residual <= balanced ||
                          assembly::check_rounding(system, state.prev, state.next,
                                                   state.multipliers, balanced, found.force_scale)
                                  .share < 1e3;
  linear.stiffness = Teuchos::rcp(new CrsMatrix(*system.matrix(), Teuchos::Copy));
  linear.damping = find_damping(system, state);
  system.prepare(state, stencil);
  const assembly::Evaluation inertia = system.evaluate(state, stencil, Want::mass);
  const auto mass = Teuchos::rcp(new CrsMatrix(*system.matrix(), Teuchos::Copy));
  remove_border(system, *mass);
  linear.mass = mass;
  if (worse(found.verdict, inertia.verdict) != Verdict::ok) {
    throw NonFiniteError(
        "Stiffness or mass is not finite where the equations are linearised.\n"
        "Try: check units and load functions.");
  }
  linear.asymmetry = solver::asymmetry(linear.stiffness, system.comm());
  if (!linear.is_equilibrium) {
    context.findings.warn(
        "no equilibrium",
        fmt::format("the state is no equilibrium: forces are out of balance by {:.2g} of the "
                    "largest one. A static analysis before this one finds the equilibrium",
                    linear.residual),
        state.time);
  }
  return linear;
}

double typical_eigenvalue(const Linearisation& linear, const assembly::System& system) {
  assembly::Vector stiffness(linear.stiffness->getRowMap());
  assembly::Vector mass(linear.stiffness->getRowMap());
  linear.stiffness->getLocalDiagCopy(stiffness);
  linear.mass->getLocalDiagCopy(mass);
  const auto k = assembly::values_of(stiffness);
  const auto m = assembly::values_of(mass);
  double sums[2] = {0.0, 0.0};  // of logarithms, and their number
  for (const assembly::Layout::LocalBlock& local : system.layout().local_blocks()) {
    const model::Block& block = system.model().unknowns().block(local.block);
    if (!local.owned || block.kind != model::BlockKind::node) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      if (block.shape.position[i] < 0) continue;
      const auto row = static_cast<std::size_t>(local.first_column + block.shape.position[i]);
      if (!(k[row] > 0.0 && m[row] > 0.0)) continue;
      sums[0] += std::log(k[row] / m[row]);
      sums[1] += 1.0;
    }
  }
  system.comm().sum(sums);
  return sums[1] > 0.0 ? std::exp(sums[0] / sums[1]) : 1.0;
}

}  // namespace culm::analysis
