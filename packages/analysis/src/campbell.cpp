#include <culm/analysis/campbell.hpp>
#include <culm/analysis/modal.hpp>
#include <culm/analysis/newton_options.hpp>
#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

// Below it a shape is not the same mode any more.
constexpr double least_assurance = 0.3;

// Goes to a level in steps that are halved where the iteration fails; at least one, because loads
// that do not depend on the level may be out of balance.
void climb(Context& context, model::State& state, solver::NewtonSolver& newton, double level) {
  const Stencil stencil = Stencil::statics();
  const double way = level - state.time_prev;
  double increment = way;
  do {
    const bool is_last = level - state.time_prev <= increment * (1.0 + 1e-9);
    state.time = is_last ? level : state.time_prev + increment;
    context.system.prepare(state, stencil);
    const solver::StepOutcome outcome = newton.solve(state, stencil);
    if (outcome.converged()) {
      context.system.accept(state);
      continue;
    }
    const double failed = state.time;
    context.system.discard(state);
    increment *= 0.5;
    if (increment <= 1e-4 * way) {
      throw NumericalError(fmt::format(
          "No equilibrium between level {:.6g} and {:.6g}: {}.\nTry: a static analysis up to "
          "there, which says more.",
          state.time_prev, failed, solver::describe(outcome.end)));
    }
  } while (state.time_prev < level);
}

// A mode on its way through the levels.
struct Followed {
  Shape shape;
  double rate = 0.0;  // [rad/s]; negative beyond the speed at which a backward whirl stands still
};

// The same motion, told with the frequency of the other sign.
Shape conjugate(Shape shape) {
  for (Vec6& motion : shape.imaginary) motion = -motion;
  return shape;
}

Followed make_followed(const Mode& mode, bool is_conjugate) {
  const double rate = mode.eigenvalue.imag();
  if (is_conjugate) return {conjugate(mode.shape), -rate};
  return {mode.shape, rate};
}

struct Match {
  int mode = -1;  // or none is like it: lost
  bool is_conjugate = false;
};

// Which of the new modes goes on with each followed one: pairs in the order of their likeness. Seen
// at rest, a frequency of a rotor changes by about the change of its speed; so one near zero may go
// on below, as the conjugate of what is found.
std::vector<Match> match(const model::Model& model, const model::State& state,
                         const std::vector<Followed>& followed, const std::vector<Mode>& modes,
                         double change_of_speed) {
  struct Pair {
    long assurance;  // in millionths: rounding decides nothing, of equal ones the first counts
    std::size_t old;
    Match now;
  };
  std::vector<Pair> pairs;
  const auto add = [&](std::size_t i, const Match& now) {
    const Followed next =
        make_followed(modes[static_cast<std::size_t>(now.mode)], now.is_conjugate);
    const bool crosses = next.rate * followed[i].rate < 0.0 || now.is_conjugate;
    if (crosses && std::abs(next.rate - followed[i].rate) > 1.5 * change_of_speed) return;
    const double assurance = modal_assurance(model, state, followed[i].shape, next.shape);
    pairs.push_back({std::lround(1e6 * assurance), i, now});
  };
  for (std::size_t i = 0; i < followed.size(); ++i) {
    for (int j = 0; j < static_cast<int>(modes.size()); ++j) {
      add(i, {j, false});
      if (change_of_speed > 0.0) add(i, {j, true});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.assurance > b.assurance; });
  std::vector<Match> found(followed.size());
  std::vector<bool> taken(modes.size(), false);
  for (const Pair& pair : pairs) {
    if (1e-6 * static_cast<double>(pair.assurance) < least_assurance) break;
    const auto mode = static_cast<std::size_t>(pair.now.mode);
    if (found[pair.old].mode >= 0 || taken[mode]) continue;
    found[pair.old] = pair.now;
    taken[mode] = true;
  }
  return found;
}

void check_levels(const Options& options, InputIssues& issues) {
  const std::vector<double>& levels = options.numbers("Levels");
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (levels[i] > levels[i - 1]) continue;
    issues.add(options.where("Levels"),
               fmt::format("levels must rise, got {:g} after {:g}", levels[i], levels[i - 1]));
    return;
  }
}

}  // namespace

Schema Campbell::schema() {
  Schema schema("Campbell",
                "Equilibrium and modes at several load levels, modes followed by their shapes: the "
                "Campbell diagram of a model with a rotating frame.");
  schema.add(numbers("Levels", "1",
                     "Load levels, rising; the speed of a rotating frame grows with "
                     "them by its function.")
                 .at_least(0.0)
                 .min_size(1));
  return add_modal_fields(schema)
      .list("Newton", newton_schema(), Presence::defaulted)
      .check(check_levels);
}

std::unique_ptr<Inspection> Campbell::make(const Options& options) {
  return std::make_unique<Campbell>(CampbellSettings{options.numbers("Levels"),
                                                     read_modal_settings(options),
                                                     newton_settings(options.list("Newton"))});
}

AnalysisReport Campbell::inspect(Context& context, model::State& state) {
  const Ledger::Scope scope(context.ledger, context.ledger.add("Campbell"));
  const model::Model& model = context.system.model();
  solver::NewtonSolver newton(context.system, context.linear, settings_.newton, context.ledger);
  // modes may leave those that are followed, so some more are looked for
  ModalSettings wider = settings_.modes;
  wider.modes += std::max(4, settings_.modes.modes / 2);
  ReportTable table{"campbell", {"level"}, {}, {}};
  std::vector<std::string> meaning;  // of the modes at the last level
  std::vector<Followed> followed;
  double speed = 0.0;  // of a turning rotor
  state.time = state.time_prev = std::min(state.time, settings_.levels.front());
  for (double level : settings_.levels) {
    climb(context, state, newton, level);
    const ModeSet set = find_modes(context, state, wider);
    if (followed.empty()) {
      const auto count =
          std::min(set.modes.size(), static_cast<std::size_t>(settings_.modes.modes));
      for (std::size_t i = 0; i < count; ++i) {
        followed.push_back(make_followed(set.modes[i], false));
        table.columns.push_back(fmt::format("frequency {} [Hz]", i + 1));
      }
      for (std::size_t i = 0; i < count; ++i) {
        table.columns.push_back(fmt::format("damping ratio {}", i + 1));
      }
    }
    const auto found = match(model, state, followed, set.modes, std::abs(set.rotor_speed - speed));
    speed = set.rotor_speed;
    std::vector<double> row{level};
    std::vector<double> damping;
    meaning.assign(followed.size(), "lost");
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i].mode < 0) {
        row.push_back(absent);
        damping.push_back(absent);
        continue;
      }
      const Mode& mode = set.modes[static_cast<std::size_t>(found[i].mode)];
      followed[i] = make_followed(mode, found[i].is_conjugate);
      meaning[i] = describe(mode, model);
      row.push_back(mode.frequency());
      damping.push_back(mode.damping());
    }
    row.insert(row.end(), damping.begin(), damping.end());
    table.rows.push_back(std::move(row));
  }
  AnalysisReport report;
  report.text = fmt::format("{:>10}  frequencies [Hz]\n", "level");
  for (const std::vector<double>& row : table.rows) {
    report.text += fmt::format("{:>10.5g} ", row.front());
    for (std::size_t i = 1; i <= followed.size(); ++i) {
      report.text +=
          row[i] == absent ? fmt::format(" {:>9}", "lost") : fmt::format(" {:>9.5g}", row[i]);
    }
    report.text += '\n';
  }
  for (std::size_t i = 0; i < meaning.size(); ++i) {
    report.text += fmt::format("{:>10}  mode {}: {}\n", i == 0 ? "at last" : "", i + 1, meaning[i]);
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace culm::analysis
