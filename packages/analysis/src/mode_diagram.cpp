#include "mode_diagram.hpp"

#include <culm/base/absent.hpp>

#include "climb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::analysis {
namespace {

// Below it a shape is not the same mode any more.
constexpr double least_assurance = 0.3;

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

}  // namespace

ModeDiagram::ModeDiagram(Context& context, const ModalSettings& modes,
                         const solver::NewtonSettings& newton, std::string title)
    : context_(context),
      asked_(static_cast<std::size_t>(modes.modes)),
      settings_(modes),
      newton_(context.system, context.linear, newton, context.ledger),
      table_{std::move(title), {"level"}, {}, {}} {
  // modes may leave those that are followed, so some more are looked for
  settings_.modes += std::max(4, modes.modes / 2);
}

ModeSet ModeDiagram::find(model::State& state, double level) {
  climb(context_, state, newton_, level);
  return find_modes(context_, state, settings_);
}

void ModeDiagram::begin(const ModeSet& set) {
  const auto count = std::min(set.modes.size(), asked_);
  for (std::size_t i = 0; i < count; ++i) {
    followed_.push_back(make_followed(set.modes[i], false));
    table_.columns.push_back(fmt::format("frequency {} [Hz]", i + 1));
  }
  for (std::size_t i = 0; i < count; ++i) {
    table_.columns.push_back(fmt::format("damping ratio {}", i + 1));
  }
}

void ModeDiagram::add(const model::State& state, const ModeSet& set) {
  const model::Model& model = context_.system.model();
  if (followed_.empty()) begin(set);
  const auto found = match(model, state, followed_, set.modes, std::abs(set.rotor_speed - speed_));
  speed_ = set.rotor_speed;
  std::vector<double> row{state.time};
  std::vector<double> damping;
  meaning_.assign(followed_.size(), "lost");
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].mode < 0) {
      row.push_back(absent);
      damping.push_back(absent);
      continue;
    }
    const Mode& mode = set.modes[static_cast<std::size_t>(found[i].mode)];
    followed_[i] = make_followed(mode, found[i].is_conjugate);
    meaning_[i] = describe(mode, model);
    row.push_back(mode.frequency());
    damping.push_back(mode.damping());
  }
  row.insert(row.end(), damping.begin(), damping.end());
  table_.rows.push_back(std::move(row));
}

std::string ModeDiagram::rows_text(const char* title, std::size_t first, double unit) const {
  std::string text = fmt::format("{:>10}  {}\n", "level", title);
  for (const std::vector<double>& row : table_.rows) {
    text += fmt::format("{:>10.5g} ", row.front());
    for (std::size_t i = first; i < first + followed_.size(); ++i) {
      text += row[i] == absent ? fmt::format(" {:>9}", "lost")
                               : fmt::format(" {:>9.5g}", row[i] / unit);
    }
    text += '\n';
  }
  return text;
}

std::string ModeDiagram::text() const {
  std::string text = rows_text("frequencies [Hz]", 1, 1.0);
  if (settings_.damping) text += rows_text("damping [%]", 1 + followed_.size(), 0.01);
  for (std::size_t i = 0; i < meaning_.size(); ++i) {
    text += fmt::format("{:>10}  mode {}: {}\n", i == 0 ? "at last" : "", i + 1, meaning_[i]);
  }
  return text;
}

}  // namespace culm::analysis
