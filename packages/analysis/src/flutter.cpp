#include <culm/analysis/flutter.hpp>
#include <culm/analysis/modal.hpp>
#include <culm/analysis/newton_options.hpp>
#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/model/method_limits.hpp>

#include "levels.hpp"
#include "mode_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace culm::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// A damping ratio below its negative is growth: what is not damped has less by rounding.
constexpr double least_rate = 1e-6;
constexpr double precision = 1e-6;  // of a level, relative
constexpr int most_trials = 60;
constexpr int most_refused = 8;
// of eigenvalues between levels, relative; below it they are the same but for rounding
constexpr double least_change = 1e-10;

// The mode that grows most, or decays least, of those of one kind.
struct Growth {
  double rate = -infinity;  // relative to its size, without least_rate
  Mode mode = {};
};

// Of oscillations.
Growth flutter_of(const ModeSet& set) {
  Growth most;
  for (const Mode& mode : set.modes) {
    if (mode.is_zero() || mode.frequency() == 0.0) continue;
    const double rate = -mode.damping() - least_rate;
    if (rate > most.rate) most = {rate, mode};
  }
  return most;
}

// Of motions without oscillation; where there are none, the slowest oscillation may become one.
Growth divergence_of(const ModeSet& set) {
  Growth most;
  for (const Mode& mode : set.modes) {
    if (mode.is_zero()) continue;
    const double size = std::abs(mode.eigenvalue);
    const double value = mode.frequency() == 0.0 ? mode.eigenvalue.real() : -size;
    if (value > most.rate) most = {value, mode};
  }
  return most;
}

// The same where damping is not known, so that two oscillations may become two motions at once,
// which means nothing: a single one more or less passes through a singular stiffness.
Growth instability_of(const ModeSet& set) {
  Growth found{-1.0, {}};
  for (const Mode& mode : set.modes) {
    if (mode.is_zero() || mode.frequency() != 0.0 || mode.eigenvalue.real() <= 0.0) continue;
    const bool is_slowest =
        found.mode.eigenvalue == 0.0 || mode.eigenvalue.real() < found.mode.eigenvalue.real();
    found = {-found.rate, is_slowest ? mode : found.mode};
  }
  return found;
}

using Measure = Growth (*)(const ModeSet&);

int count_growing(const ModeSet& set) {
  return static_cast<int>(std::ranges::count_if(set.modes, [](const Mode& mode) {
    return !mode.is_zero() && mode.frequency() == 0.0 && mode.eigenvalue.real() > 0.0;
  }));
}

struct Crossing {
  const char* name;
  Measure of_modes;
  bool by_stiffness = false;  // where the sign of the stiffness is known, it decides
  int stable_sign = 0;        // of a stiffness with which no motion grows; 0: not known
  std::optional<double> below, above = {};  // levels between which it happens
  double rate_below = 0.0, rate_above = 0.0;
  Growth at_above = {};
  bool is_within = false;                  // no equilibrium is found between these levels
  std::optional<double> early_until = {};  // it happens from the first level to this one at least

  void begin(const ModeSet& first) {
    if (!by_stiffness) return;
    const bool is_free =
        std::ranges::any_of(first.modes, [](const Mode& m) { return m.is_zero(); });
    stable_sign = is_free ? 0 : first.stiffness_sign * (count_growing(first) % 2 == 0 ? 1 : -1);
  }
  // The mode that begins to grow is not always among those that are found, the sign is; where two
  // begin together it is the sign that does not show it.
  Growth measure(const ModeSet& set) const {
    Growth found = of_modes(set);
    if (stable_sign == 0 || set.stiffness_sign == 0) return found;
    if (of_modes == divergence_of && found.rate > 0.0) return found;
    found.rate = set.stiffness_sign == stable_sign ? -1.0 : 1.0;
    if (found.mode.frequency() != 0.0) found.mode.eigenvalue = found.mode.eigenvalue.real();
    return found;
  }
  void see(double level, const ModeSet& set) {
    if (happens()) return;
    const Growth found = measure(set);
    const double rate = found.rate;
    if (rate > 0.0) {
      above = level;
      rate_above = rate;
      at_above = found;
    } else {
      if (above) early_until = above;
      above.reset();
      below = level;
      rate_below = rate;
    }
  }
  bool happens() const { return below && above; }
  /// What grows at levels below those at which it is looked for; empty if nothing does.
  std::string early() const {
    if (early_until) return fmt::format("{} up to level {:.6g} at least", name, *early_until);
    return above && !below ? fmt::format("{} below the first level", name) : "";
  }
  std::string text(const std::optional<Growth>& growth, const std::vector<double>& levels) const {
    if (!growth) {
      const std::string found = early();
      if (above) return fmt::format("{}, {:.6g}", found, levels.front());
      return fmt::format("{}no {} up to level {:.6g}", found.empty() ? "" : found + ", above it ",
                         name, levels.back());
    }
    const std::string before = early_until ? early() + ", and " : "";
    const double frequency = growth->mode.frequency();
    const std::string with = frequency > 0.0 ? fmt::format(", with {:.6g} Hz", frequency) : "";
    const std::string within =
        is_within
            ? fmt::format("; between {:.7g} and {:.7g} no equilibrium was found", *below, *above)
            : "";
    return fmt::format("{}{} from level {:.7g} on{}{}", before, name, *above, with, within);
  }
  std::string remark(const std::optional<Growth>& growth, const model::Model& model) const {
    const std::string before = early();
    if (!growth) return before.empty() ? fmt::format("no {}", name) : before;
    return fmt::format("{}{}: {}", before.empty() ? "" : before + ", and ", name,
                       describe(growth->mode, model));
  }
};

// Nothing where no equilibrium is found, of a crossing that is one of the stiffness.
std::optional<Growth> measure_at(double level, const Crossing& crossing, ModeDiagram& diagram,
                                 model::State& state) {
  if (!crossing.by_stiffness) return crossing.measure(diagram.find(state, level));
  try {
    return crossing.measure(diagram.find(state, level));
  } catch (const NumericalError&) {
    return {};
  }
}

// Halves and secants in turn: growth may have kinks, and jumps where motions cease to oscillate.
// Near where the stiffness vanishes there may be no equilibrium to be found: other levels between
// are tried then, and a level among those without one is the level that is looked for.
Growth close_in(Crossing& crossing, ModeDiagram& diagram, model::State& state) {
  Growth last = crossing.at_above;
  double &below = *crossing.below, &above = *crossing.above;
  int refused = 0;  // trials in turn without equilibrium
  for (int i = 0; i < most_trials && above - below > precision * above; ++i) {
    const bool has_secant = i % 2 == 0 && std::isfinite(crossing.rate_below);
    const double share =
        has_secant ? -crossing.rate_below / (crossing.rate_above - crossing.rate_below) : 0.5;
    const double elsewhere = std::fmod(0.5 + refused * std::numbers::phi, 1.0);
    // a little off the secant, so that both ends come
    const double level =
        below + std::clamp(refused == 0 ? share : elsewhere, 0.01, 0.99) * (above - below);
    const std::optional<Growth> here = measure_at(level, crossing, diagram, state);
    if (!here) {
      if (++refused < most_refused) continue;
      above = level;
      crossing.is_within = true;
      return last;
    }
    refused = 0;
    const Growth& found = *here;
    if (found.rate > 0.0) {
      above = level;
      crossing.rate_above = found.rate;
      last = found;
    } else {
      below = level;
      crossing.rate_below = found.rate;
    }
  }
  return last;
}

// Whether all forces are in the linearisation: without damping and inertia of a fluid, oscillations
// that grow have no meaning.
bool knows_all_forces(const model::Model& model) {
  return std::ranges::none_of(model.batches(), [](const model::Batch* batch) {
    const auto* partly = dynamic_cast<const model::LeftOutOfModes*>(batch);
    return partly != nullptr && !partly->left_out_of_modes().empty();
  });
}

// How far eigenvalues are from those of another level, over the largest of these.
double change_of(const ModeSet& here, const ModeSet& there) {
  if (here.modes.size() != there.modes.size()) return infinity;
  double change = 0.0, size = 0.0;
  for (std::size_t i = 0; i < here.modes.size(); ++i) {
    change = std::max(change, std::abs(here.modes[i].eigenvalue - there.modes[i].eigenvalue));
    size = std::max(size, std::abs(there.modes[i].eigenvalue));
  }
  return size > 0.0 ? change / size : infinity;
}

}  // namespace

Schema Flutter::schema() {
  Schema schema("Flutter",
                "Equilibrium and modes at several load levels, and the levels at which motions "
                "begin to grow: flutter and divergence. Modes are damped, with the lag of air.");
  add_levels(schema, "Load levels, rising; the wind grows with them by its function.");
  return add_mode_fields(schema).list("Newton", newton_schema(), Presence::defaulted);
}

std::unique_ptr<Inspection> Flutter::make(const Options& options) {
  ModalSettings modes = read_mode_settings(options);
  modes.damping = true;
  modes.expects_zero = modes.stiffness_sign = true;  // at divergence
  return std::make_unique<Flutter>(CampbellSettings{options.numbers("Levels"), std::move(modes),
                                                    newton_settings(options.list("Newton"))});
}

AnalysisReport Flutter::inspect(Context& context, model::State& state) {
  const Ledger::Scope scope(context.ledger, context.ledger.add("Flutter"));
  ModeDiagram diagram(context, settings_.modes, settings_.newton, "flutter");
  const bool looks_for_flutter = knows_all_forces(context.system.model());
  Crossing crossings[] = {
      {"flutter", flutter_of, false, 0, {}},
      {"divergence", looks_for_flutter ? divergence_of : instability_of, true, 0, {}}};
  state.time = state.time_prev = std::min(state.time, settings_.levels.front());
  std::optional<ModeSet> first;
  double largest_change = settings_.levels.size() > 1 ? 0.0 : infinity;
  for (double level : settings_.levels) {
    const ModeSet set = diagram.find(state, level);
    if (!first) {
      first = set;
      for (Crossing& crossing : crossings) crossing.begin(set);
    }
    largest_change = std::max(largest_change, change_of(set, *first));
    diagram.add(state, set);
    for (Crossing& crossing : crossings) crossing.see(level, set);
  }
  if (largest_change < least_change) {
    context.findings.warn("levels",
                          "the modes are the same at all levels of 'Flutter': nothing that acts on "
                          "them changes with the level. Give the flow a 'Function' that does",
                          state.time);
  }
  AnalysisReport report;
  report.text = diagram.text();
  report.tables.push_back(diagram.table());
  ReportTable onset{"onset", {"level", "frequency [Hz]"}, {}, {}};
  for (Crossing& crossing : crossings) {
    if (crossing.of_modes == flutter_of && !looks_for_flutter) {
      report.text += "flutter is not looked for: linear analyses do not know all forces here\n";
      onset.rows.push_back({absent, absent});
      onset.remarks.push_back("flutter is not looked for");
      continue;
    }
    const std::optional<Growth> growth =
        crossing.happens() ? std::optional(close_in(crossing, diagram, state)) : std::nullopt;
    report.text += crossing.text(growth, settings_.levels) + '\n';
    onset.rows.push_back(
        {growth ? *crossing.above : absent, growth ? growth->mode.frequency() : absent});
    onset.remarks.push_back(crossing.remark(growth, context.system.model()));
  }
  report.tables.push_back(std::move(onset));
  diagram.find(state, settings_.levels.back());
  return report;
}

}  // namespace culm::analysis
