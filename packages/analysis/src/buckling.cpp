#include <culm/analysis/buckling.hpp>
#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/solver/asymmetry.hpp>
#include <culm/solver/eigen_solver.hpp>

#include "even_growth.hpp"
#include "softest_direction.hpp"
#include "turn_before_buckling.hpp"
#include "wall_limits.hpp"
#include "weak_direction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

using assembly::Matrix;
using assembly::Vector;

// Loads that follow the structure leave a tenth and more; a small difference of large tangents has
// more rounding than a tangent.
constexpr double largest_asymmetry_of_change = 1e-3;

// Of a factor, that rounding may take: 0.05 %.
constexpr double smallest_share = 5e-4;

// Of the factor at which a wall is unstable by itself: long waves are right up to here, and mixed
// with short ones beyond.
constexpr double notable_wall = 0.9;

// Of a factor, that rounding may take before it is worth nothing: errors are up to ten times as
// large then.
constexpr double worthless_share = 0.2;

// Factors about a tangent that is not regular are made of rounding, and a load that does no work in
// the free motion does not show it.
void require_regular(Context& context, const model::State& state) {
  std::optional<Vector> direction;
  const assembly::Rows& rows = context.system.layout().rows();
  const bool is_factored = context.linear.factor();
  const WeakDirection weak(context.system, state);
  if (is_factored) direction = softest_direction(context.linear, rows);
  if (direction && !weak.is_free(*direction)) return;
  if (!direction) context.linear.weakest_direction(direction.emplace(rows));
  throw NumericalError(context.system.comm().broadcast(
      fmt::format("The tangent at level {:g} is singular: factors would be made of rounding.\n{}\n"
                  "At a limit point, take a state before it.",
                  state.time, weak.singular_cause(*direction))));
}

// The linear response to the loads of another level, zero where they do not move anything, as heat
// does not between supports. The matrix of the system is the tangent then.
Vector linear_step(Context& context, model::State at, double level) {
  assembly::System& system = context.system;
  const Stencil stencil = Stencil::statics();
  const double present = at.time;
  at.prev = at.next;
  at.time = at.time_prev = level;
  system.prepare(at, stencil);
  system.evaluate(at, stencil, Want::residual);
  Vector load = system.residual();
  at.time = at.time_prev = present;
  system.prepare(at, stencil);
  const assembly::Evaluation found = system.evaluate(at, stencil, Want::residual_and_tangent);
  load.update(1.0, system.residual(), -1.0);
  const double size = load.largest();
  Vector step(load.rows());
  require_regular(context, at);
  if (size <= 1e-12 * found.force_scale || size == 0.0) return step;
  if (!context.linear.solve(load, step).is_sound()) {
    throw NumericalError(
        "The linear response to the reference load is lost in rounding: stiffnesses differ too "
        "much in size.\nTry: check units; make what is very stiff rigid.");
  }
  return step;
}

// What the linear step adds to the tangent, all of it linear in the step: stresses where the
// structure is, multipliers, loads. A difference that is small beside the tangent would be made of
// rounding, so the step is taken as many times as large as it takes.
std::shared_ptr<const Matrix> stress_stiffness(Context& context, model::State at, double level,
                                               const Vector& step, const Matrix& tangent) {
  assembly::System& system = context.system;
  const Stencil stencil = Stencil::statics();
  at.time = at.time_prev = level;
  const auto with = [&](double times) {
    model::State moved = at;
    system.prepare(moved, stencil);
    system.extrapolate(moved, stencil, step, times);
    system.move(moved, step, times);
    moved.next = at.next;
    system.evaluate(moved, stencil, Want::residual_and_tangent);
    return std::make_shared<Matrix>(*system.matrix());
  };
  const auto subtract = [](Matrix& from, const Matrix& what) {
    const auto values = from.values();
    const auto others = what.values();
    for (std::size_t k = 0; k < values.size(); ++k) values[k] -= others[k];
  };
  auto change = with(1.0);
  subtract(*change, tangent);
  const double enough = 1e-6 * tangent.norm();
  constexpr double factor = 0x1p20, most = 0x1p200;
  if (change->norm() >= enough || step.largest() == 0.0) return change;
  const auto without = with(0.0);
  double times = 1.0;
  do {
    times *= factor;
    change = with(times);
    subtract(*change, *without);
  } while (change->norm() < enough && times < most);
  subtract(*without, tangent);
  const auto values = change->values();
  const auto loads = without->values();
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = values[k] / times + loads[k];
  return change;
}

// A load moves the structure, or it stresses it where it is.
void require_load(const Vector& step, const Matrix& change, const Matrix& tangent, double level,
                  double present) {
  if (step.largest() > 0.0) return;
  if (change.norm() > 1e-12 * tangent.norm()) return;
  throw NumericalError(
      fmt::format("There is no reference load: loads at level {:g} are those at level {:g}.\n"
                  "Try: a 'Reference Level' at which the functions of the loads differ.",
                  level, present));
}

// A largest displacement of 1 m, or a largest rotation of 1 rad where nothing is displaced.
void normalise(Shape& shape) {
  double displacement = 0.0;
  double rotation = 0.0;
  double signed_displacement = 1.0;
  for (const Vec6& motion : shape.real) {
    rotation = std::max(rotation, motion.tail<3>().norm());
    // of nodes that move alike the first decides on the sign
    if (motion.head<3>().norm() <= 1.001 * displacement) continue;
    displacement = motion.head<3>().norm();
    Eigen::Index axis = 0;
    motion.head<3>().cwiseAbs().maxCoeff(&axis);
    signed_displacement = std::copysign(displacement, motion[axis]);
  }
  const double scale = displacement > 1e-9 * rotation ? signed_displacement : rotation;
  for (Vec6& motion : shape.real) motion /= scale;
}

// Shapes have x^T K x = 1, of which large terms that cancel leave their rounding, a tenth of the
// bound.
void warn_of_rounding(const solver::EigenPairs& pairs, double time, Findings& findings) {
  for (std::size_t i = 0; i < pairs.values.size(); ++i) {
    const double share = 0.1 * pairs.rounding[i];
    if (share < smallest_share) continue;
    const std::string text = fmt::format(
        "rounding leaves the factor of mode {} exact to {:.2g} % only: stiffnesses differ too much "
        "in size",
        i + 1, 100.0 * share);
    if (share < worthless_share) {
      findings.warn("hidden modes", text, time);
    } else {
      findings.broken("hidden modes", text + ", and it is worth nothing", time);
    }
    return;
  }
}

// What is right for waves longer than the thickness of a wall ends where its own stiffness in shear
// does: factors beyond, and those close below, belong to waves that no mesh resolves.
void warn_of_walls(const solver::EigenPairs& pairs, const WallLimits& limits, double time,
                   Findings& findings) {
  for (std::size_t i = 0; i < pairs.values.size(); ++i) {
    const double factor = pairs.values[i];
    const WallLimit& limit = factor > 0.0 ? limits.positive : limits.negative;
    const double ratio = std::abs(factor / limit.factor);
    if (!(ratio >= notable_wall)) continue;
    findings.warn(
        "thick wall",
        fmt::format("mode {}, factor {:.5g}, lies at {:.2f} times the factor at which compression "
                    "leaves the wall of '{}' no stiffness in shear, {:.5g} (element {}): there it "
                    "is unstable against waves shorter than its thickness, and factors fall "
                    "towards that value as the mesh is refined. The wall is too thick, or too soft "
                    "in shear, for such a load; factors well below are good",
                    i + 1, factor, ratio, limit.structure, limit.factor, limit.cell),
        time);
    return;
  }
}

}  // namespace

Schema Buckling::schema() {
  const BucklingSettings defaults;
  return Schema("Buckling",
                "Linear buckling about the present state, which stays as it is: factors of the "
                "reference load at which the structure loses its stiffness against a shape.")
      .add(integer("Modes", "How many factors to find, of both signs, next to zero.")
               .between(1, 100'000)
               .optional(defaults.modes))
      .add(number("Reference Level", "1",
                  "The reference load is the load at this level less the present one. If absent, "
                  "level 1, or level 0 where 1 is reached.")
               .optional())
      .add(choice("Solver", solver::buckling_solver_names(),
                  "Of the eigenproblem: Spectra for large models; Dense reduces whole matrices, "
                  "best for small ones and to check; Automatic decides.")
               .optional(defaults.solver));
}

std::unique_ptr<Inspection> Buckling::make(const Options& options) {
  BucklingSettings settings;
  settings.modes = options.integer("Modes");
  if (options.has("Reference Level")) settings.reference_level = options.number("Reference Level");
  settings.where = options.where("Reference Level");
  settings.solver = options.text("Solver");
  return std::make_unique<Buckling>(std::move(settings));
}

double Buckling::reference_level(const model::State& state) const {
  const double level = settings_.reference_level.value_or(state.time < 1.0 ? 1.0 : 0.0);
  if (level == state.time) {
    throw InputError(settings_.where,
                     fmt::format("the state is at level {:g}; the reference load is the difference "
                                 "to another level",
                                 level));
  }
  return level;
}

void Buckling::begin(Context& context, model::State& state) {
  const Ledger::Scope scope(context.ledger, context.ledger.add("Eigenproblem"));
  const Stencil stencil = Stencil::statics();
  context.system.prepare(state, stencil);
  context.system.choose_multiplier_scale(state, stencil);  // in which the step has its multipliers
  step_ = linear_step(context, state, reference_level(state));
}

AnalysisReport Buckling::inspect(Context& context, model::State& state) {
  const Ledger::Scope scope(context.ledger, context.ledger.add("Eigenproblem"));
  assembly::System& system = context.system;
  const double level = reference_level(state);
  const bool has_levels = grow_evenly(context, state, level);
  if (!has_levels) {
    context.findings.warn(
        "levels",
        fmt::format(
            "loads do not grow evenly from level {:g} to level {:g}, as those of a rotating "
            "frame or of functions that are no straight line: factors are on the reference "
            "load, and which level has so much of it is not known",
            state.time, level),
        state.time);
  }
  const Linearisation linear = linearise(context, state, Stencil::statics());
  model::Coordinates motion = system.linear_motion(state, *step_, 1.0);
  system.complete(motion);
  const auto change = stress_stiffness(context, state, level, *step_, *linear.stiffness);
  require_load(*step_, *change, *linear.stiffness, level, state.time);
  system.prepare(state, Stencil::statics());  // back from the other level, for results
  const bool is_symmetric = linear.asymmetry <= largest_asymmetry &&
                            solver::asymmetry_within(change, linear.stiffness, system.comm()) <=
                                largest_asymmetry_of_change;
  if (!is_symmetric) {
    context.findings.warn(
        "unsymmetric",
        "the tangent is not symmetric, as with loads that follow the structure: it may become "
        "unstable by flutter before it buckles, which a modal analysis shows",
        state.time);
  }
  solver::EigenSettings settings;
  settings.solver = settings_.solver;
  settings.linear_solver = context.linear.name();
  settings.count = settings_.modes;
  const solver::EigenPairs pairs =
      solver::solve_buckling({linear.stiffness, change, is_symmetric}, settings, system.comm());

  system.synchronise(state);
  AnalysisReport report;
  ReportTable table{"buckling", {"mode", "factor", "critical level"}, {}, {}};
  report.text = fmt::format(
      "buckling under the load of level {:g} less that of level {:g}\n{:>5} {:>14} {:>15}\n", level,
      state.time, "mode", "factor", "critical level");
  for (std::size_t i = 0; i < pairs.values.size(); ++i) {
    const double factor = pairs.values[i];
    const double critical = has_levels ? state.time + factor * (level - state.time) : absent;
    const auto number = static_cast<double>(i + 1);
    table.rows.push_back({number, factor, critical});
    report.text +=
        fmt::format("{:>5} {:>14.8g} ", i + 1, factor) +
        (has_levels ? fmt::format("{:>15.8g}\n", critical) : fmt::format("{:>15}\n", "-"));
    Shape shape{fmt::format("mode {}, factor {:.5g}", i + 1, factor),
                node_motions(system, state, pairs.vectors.col(static_cast<Eigen::Index>(i))),
                {}};
    normalise(shape);
    report.shapes.push_back(std::move(shape));
  }
  warn_of_rounding(pairs, state.time, context.findings);
  if (!pairs.values.empty()) {
    warn_of_turns(system.model(), state.next, motion, pairs.values.front(), state.time,
                  context.findings);
  }
  warn_of_walls(pairs, find_wall_limits(system, state.next, motion), state.time, context.findings);
  if (!pairs.note.empty()) context.log.info("note: " + pairs.note);
  // of an unsymmetric tangent that has no real factors complex ones may be left
  const bool are_all = pairs.are_all && (is_symmetric || !pairs.values.empty());
  if (static_cast<int>(pairs.values.size()) < settings_.modes && !are_all) {
    const std::string missing = fmt::format(
        "{} factors were asked for, but only {} real ones were "
        "found",
        settings_.modes, pairs.values.size());
    report.text += missing + '\n';
    context.findings.warn("eigenvalues", missing, state.time);
  } else if (pairs.values.empty()) {
    report.text += "  none: the load cannot make the structure buckle\n";
  } else if (static_cast<int>(pairs.values.size()) < settings_.modes) {
    report.text += fmt::format("{} factors were asked for, but there are {} only\n",
                               settings_.modes, pairs.values.size());
  }
  report.text +=
      fmt::format("eigensolver: {}, largest residual {:.1e}\n", pairs.solver, pairs.worst_residual);
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace culm::analysis
