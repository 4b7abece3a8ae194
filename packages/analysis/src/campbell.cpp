#include <culm/analysis/campbell.hpp>
#include <culm/analysis/modal.hpp>
#include <culm/analysis/newton_options.hpp>
#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

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
    context.system.begin_step(state, stencil);
    const solver::StepOutcome outcome = newton.solve(state, stencil);
    if (outcome.converged()) {
      accept(state);
      continue;
    }
    const double failed = state.time;
    reject(state);
    increment *= 0.5;
    if (increment <= 1e-4 * way) {
      throw NumericalError(fmt::format(
          "No equilibrium between level {:.6g} and {:.6g}: {}.\nTry: a static analysis up to "
          "there, which says more.",
          state.time_prev, failed, solver::describe(outcome.end)));
    }
  } while (state.time_prev < level);
}

// Which of the new modes goes on with each followed one: pairs in the order of their likeness. A
// mode that none is like is lost, -1.
std::vector<int> match(const model::Model& model, const model::State& state,
                       const std::vector<Shape>& followed, const std::vector<Mode>& modes) {
  struct Pair {
    double assurance;
    std::size_t old;
    std::size_t now;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < followed.size(); ++i) {
    for (std::size_t j = 0; j < modes.size(); ++j) {
      pairs.push_back({modal_assurance(model, state, followed[i], modes[j].shape), i, j});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.assurance > b.assurance; });
  std::vector<int> found(followed.size(), -1);
  std::vector<bool> taken(modes.size(), false);
  for (const Pair& pair : pairs) {
    if (pair.assurance < least_assurance) break;
    if (found[pair.old] >= 0 || taken[pair.now]) continue;
    found[pair.old] = static_cast<int>(pair.now);
    taken[pair.now] = true;
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
                "Campbell diagram of a model in a rotating frame.");
  schema.add(numbers("Levels", "1",
                     "Load levels, rising; the speed of a rotating frame grows with "
                     "them by its function.")
                 .at_least(0.0)
                 .min_size(1));
  return add_modal_fields(schema)
      .list("Newton", newton_schema(), Presence::defaulted)
      .check(check_levels);
}

std::unique_ptr<Analysis> Campbell::make(const Options& options) {
  return std::make_unique<Campbell>(CampbellSettings{options.numbers("Levels"),
                                                     read_modal_settings(options),
                                                     newton_settings(options.list("Newton"))});
}

AnalysisReport Campbell::advance(Context& context, model::State& state, Observer&) {
  const Ledger::Scope scope(context.ledger, context.ledger.add("Campbell"));
  const model::Model& model = context.system.model();
  solver::NewtonSolver newton(context.system, context.linear, settings_.newton, context.ledger);
  // modes may leave those that are followed, so some more are looked for
  ModalSettings wider = settings_.modes;
  wider.modes += std::max(4, settings_.modes.modes / 2);
  ReportTable table{"campbell", {"level"}, {}, {}};
  std::vector<Shape> followed;
  state.time = state.time_prev = std::min(state.time, settings_.levels.front());
  for (double level : settings_.levels) {
    climb(context, state, newton, level);
    const ModeSet set = find_modes(context, state, wider);
    if (followed.empty()) {
      const auto count =
          std::min(set.modes.size(), static_cast<std::size_t>(settings_.modes.modes));
      for (std::size_t i = 0; i < count; ++i) {
        followed.push_back(set.modes[i].shape);
        table.columns.push_back(fmt::format("frequency {} [Hz]", i + 1));
      }
      for (std::size_t i = 0; i < count; ++i) {
        table.columns.push_back(fmt::format("damping ratio {}", i + 1));
      }
    }
    const std::vector<int> found = match(model, state, followed, set.modes);
    std::vector<double> row{level};
    std::vector<double> damping;
    for (std::size_t i = 0; i < found.size(); ++i) {
      constexpr double lost = std::numeric_limits<double>::quiet_NaN();
      if (found[i] < 0) {
        row.push_back(lost);
        damping.push_back(lost);
        continue;
      }
      const Mode& mode = set.modes[static_cast<std::size_t>(found[i])];
      followed[i] = mode.shape;
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
    for (std::size_t i = 1; i <= followed.size(); ++i)
      report.text += fmt::format(" {:>9.5g}", row[i]);
    report.text += '\n';
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace culm::analysis
