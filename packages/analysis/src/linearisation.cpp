#include <culm/analysis/linearisation.hpp>
#include <culm/assembly/rounding.hpp>
#include <culm/base/error.hpp>
#include <culm/model/branch_store.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/solver/asymmetry.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

using assembly::Matrix;

// Which unknowns of the system a matrix keeps.
enum class Keep {
  motions,  // those of nodes
  states,   // and those of batches that are no forces of equations
};

bool is_kept(const model::Model& model, const model::Block& block, int i, Keep keep) {
  if (keep == Keep::motions) return block.kind == model::BlockKind::node;
  return !model.is_force(block, i);
}

// Whether the unknown of each local column is kept.
std::vector<bool> kept_columns(const assembly::System& system, Keep keep) {
  const model::Model& model = system.model();
  std::vector<bool> kept;
  for (const assembly::Layout::LocalBlock& local : system.layout().local_blocks()) {
    const model::Block block = model.unknowns().block(local.block);
    const auto end = static_cast<std::size_t>(local.first_column + block.shape.active);
    if (kept.size() < end) kept.resize(end, false);
    for (int i = 0; i < block.shape.width; ++i) {
      const int at = block.shape.position[static_cast<std::size_t>(i)];
      if (at < 0) continue;
      kept[static_cast<std::size_t>(local.first_column + at)] = is_kept(model, block, i, keep);
    }
  }
  return kept;
}

template <class Wanted>
void erase_unless(Matrix& matrix, const Wanted& wanted) {
  const auto begin = matrix.row_begin();
  for (std::size_t row = 0; row + 1 < begin.size(); ++row) {
    for (std::size_t k = begin[row]; k < begin[row + 1]; ++k) {
      if (!wanted(row, static_cast<std::size_t>(matrix.column_of()[k]))) matrix.values()[k] = 0.0;
    }
  }
}

// Constraints border the matrices of inertia and damping, and have no part in them.
void remove_border(const assembly::System& system, Keep keep, Matrix& matrix) {
  const std::vector<bool> kept = kept_columns(system, keep);
  erase_unless(matrix,
               [&](std::size_t row, std::size_t column) { return kept[row] && kept[column]; });
}

double largest_entry(const assembly::System& system, const Matrix& matrix) {
  double largest = 0.0;
  for (const double value : matrix.values()) largest = std::max(largest, std::abs(value));
  return system.comm().max(largest);
}

std::vector<LinearBranches> find_branches(assembly::System& system, const model::State& state) {
  std::vector<LinearBranches> all;
  for (double time : system.relaxation_times()) {
    if (system.evaluate_branches(state, time) != Verdict::ok) {
      throw NonFiniteError("The stiffness of branches of 'Relaxation' is not finite.");
    }
    all.push_back({time, std::make_shared<Matrix>(*system.matrix())});
  }
  return all;
}

// Of a delayed force the part by velocities is what falls as 1 / step, like damping.
void add_delayed(assembly::System& system, const model::State& state, Linearisation& linear) {
  const Stencil steady = Stencil::linearisation();
  const Stencil moving{1.0, 1.0, 1.0, 0.0};
  for (double delay : system.delays(state)) {
    Verdict verdict = system.evaluate_delayed(state, steady, delay);
    const auto stiffness = std::make_shared<Matrix>(*system.matrix());
    verdict = worse(verdict, system.evaluate_delayed(state, moving, delay));
    const auto damping = std::make_shared<Matrix>(*system.matrix());
    const auto values = damping->values();
    const auto without = stiffness->values();
    for (std::size_t k = 0; k < values.size(); ++k) values[k] -= without[k];
    if (verdict != Verdict::ok) throw NonFiniteError("Forces with a delay are not finite.");
    linear.branches.push_back({delay, stiffness, damping});
  }
}

// Takes away what branches gain from one step to another, but for rounding.
void remove_branches(const assembly::System& system, const std::vector<LinearBranches>& branches,
                     double before, double after, Matrix& matrix) {
  if (branches.empty()) return;
  const double negligible = 1e-13 * largest_entry(system, *system.matrix());
  const auto values = matrix.values();
  for (const LinearBranches& branch : branches) {
    const auto weight = [&](double step) {
      return model::branch_weight(MaxwellStep::of(step, branch.time), 1.0);
    };
    const double gained = weight(after) - weight(before);
    const auto stiffness = branch.stiffness->values();
    for (std::size_t k = 0; k < values.size(); ++k) values[k] -= gained * stiffness[k];
  }
  for (double& value : values) {
    if (std::abs(value) <= negligible) value = 0.0;
  }
}

// What of the tangent a step of half the length has more, which is damping over the length.
std::shared_ptr<Matrix> find_gain(assembly::System& system, const model::State& state,
                                  const std::vector<LinearBranches>& branches, double long_step) {
  const double short_step = 0.5 * long_step;
  std::shared_ptr<Matrix> gain;
  for (const double step : {long_step, short_step}) {
    const Stencil stencil{step, 1.0, 1.0, 0.0};
    system.prepare(state, stencil);
    system.evaluate(state, stencil, Want::residual_and_tangent);
    const auto tangent = system.matrix()->values();
    if (!gain) {
      gain = std::make_shared<Matrix>(*system.matrix());
      continue;
    }
    const auto values = gain->values();
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = tangent[k] - values[k];
  }
  remove_branches(system, branches, long_step, short_step, *gain);
  remove_border(system, Keep::states, *gain);
  return gain;
}

// Velocities are differences of coordinates over the step, so the damping is what of the tangent
// falls as 1 / step. Everything else is the same to the last bit, but for branches, which are
// known. Where the damping is little beside the stiffness, as at high frequencies, it would be
// rounding of it: then once more with a step, a power of two, that makes both of one size.
std::shared_ptr<Matrix> find_damping(assembly::System& system, const model::State& state,
                                     const std::vector<LinearBranches>& branches) {
  constexpr double little = 1e-3;
  std::shared_ptr<Matrix> damping = find_gain(system, state, branches, 1.0);
  const double size = largest_entry(system, *damping);
  if (size == 0.0) return nullptr;
  const double share = size / largest_entry(system, *system.matrix());
  if (share >= little) return damping;
  const double step = std::exp2(std::floor(std::log2(share)));
  damping = find_gain(system, state, branches, step);
  for (double& value : damping->values()) value *= step;
  return damping;
}

}  // namespace

bool damps_motions(const assembly::System& system, const std::shared_ptr<const Matrix>& damping) {
  if (!damping) return false;
  const std::vector<bool> is_motion = kept_columns(system, Keep::motions);
  Matrix between = *damping;
  erase_unless(between, [&](std::size_t row, std::size_t column) {
    return is_motion[row] && is_motion[column];
  });
  return largest_entry(system, between) > 0.0;
}

bool feels_rates(assembly::System& system, const model::State& state) {
  return damps_motions(system, find_damping(system, state, find_branches(system, state)));
}

std::shared_ptr<const Matrix> rates_of_signals(const assembly::System& system,
                                               const std::shared_ptr<const Matrix>& damping) {
  if (!damping || system.model().unknowns().num_signals() == 0) return nullptr;
  const std::vector<bool> is_motion = kept_columns(system, Keep::motions);
  const auto rates = std::make_shared<Matrix>(*damping);
  erase_unless(*rates, [&](std::size_t row, std::size_t column) {
    return !is_motion[row] || !is_motion[column];
  });
  if (largest_entry(system, *rates) == 0.0) return nullptr;
  return rates;
}

Linearisation linearise(Context& context, const model::State& state, const Stencil& stencil) {
  assembly::System& system = context.system;
  system.prepare(state, stencil);
  system.choose_multiplier_scale(state, stencil);
  const assembly::Evaluation found = system.evaluate(state, stencil, Want::residual_and_tangent);
  Linearisation linear;
  if (found.force_scale > 0.0) linear.residual = found.force_residual / found.force_scale;
  const double balanced = 1e-6 * found.force_scale;
  // what rounding may leave, with a margin for states that other programs or analyses found
  constexpr double margin = 1e3;
  linear.is_equilibrium =
      found.force_residual <= balanced ||
      assembly::check_rounding(system, {state.prev, state.next, state.multipliers, state.own},
                               balanced, found.force_scale, margin)
              .share < margin;
  linear.stiffness = std::make_shared<Matrix>(*system.matrix());
  linear.branches = find_branches(system, state);
  linear.damping = find_damping(system, state, linear.branches);
  add_delayed(system, state, linear);
  system.prepare(state, stencil);
  const assembly::Evaluation inertia = system.evaluate(state, stencil, Want::mass);
  const auto mass = std::make_shared<Matrix>(*system.matrix());
  remove_border(system, Keep::motions, *mass);
  linear.mass = mass;
  if (worse(found.verdict, inertia.verdict) != Verdict::ok) {
    throw NonFiniteError(
        "Stiffness or mass is not finite where the equations are linearised.\n"
        "Try: check units and load functions.");
  }
  linear.asymmetry = solver::asymmetry(linear.stiffness, system.comm());
  for (const model::Batch* batch : system.model().batches()) {
    const auto* partly = dynamic_cast<const model::LeftOutOfModes*>(batch);
    const std::string missing = partly == nullptr ? "" : partly->left_out_of_modes();
    if (!missing.empty()) context.findings.warn("left out", missing, state.time);
  }
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
  const std::vector<double> k = linear.stiffness->diagonal();
  const std::vector<double> m = linear.mass->diagonal();
  double sums[2] = {0.0, 0.0};  // of logarithms, and their number
  for (const assembly::Layout::LocalBlock& local : system.layout().local_blocks()) {
    const model::Block block = system.model().unknowns().block(local.block);
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
