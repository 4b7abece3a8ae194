// How a coupled run finds loads that fit the motion of a window.

#include <culm/base/error.hpp>
#include <culm/coupling/messages.hpp>

#include "coupled_run.hpp"
#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace culm::simulation {
namespace {

using coupling::bit;
using Eigen::VectorXd;

constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();

// Whether the later half of the attempts came notably nearer than the first.
bool is_falling(const std::vector<double>& misses) {
  constexpr double notable = 0.5;
  const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
  if (middle == misses.begin()) return true;
  return *std::min_element(middle, misses.end()) <
         notable * *std::min_element(misses.begin(), middle);
}

}  // namespace

bool CoupledRun::make_window(CoupledWindow& window) {
  if (sees_motion() && scheme_->is_implicit()) {
    return is_parallel_ ? repeat_in_parallel(window) : repeat(window);
  }
  std::vector<coupling::Window> asked;
  if (!sees_motion()) {
    asked = window.at_rest();
    loads_ = ask(asked);
  } else if (is_parallel_) {
    asked = window.foreseen();
    pose(asked);
  }
  for (const CoupledSide& side : sides_) side.set(loads_);
  const bool is_bearable = window.go();
  VectorXd answer = loads_;
  if (sees_motion() && is_parallel_) answer = collect(asked);
  if (!is_bearable) {
    window.go_back();
    return false;
  }
  if (sees_motion()) {
    if (!is_parallel_) {
      asked = window.about(0);
      answer = ask(asked);
    }
    watch(window, asked, answer);
  }
  accept(window, 1);
  loads_ = answer;
  return true;
}

bool CoupledRun::repeat(CoupledWindow& window) {
  const int most = settings_.integer("Most Attempts");
  const VectorXd first = loads_;
  VectorXd bearable;  // the last loads that the structure converged with
  std::vector<double> misses;
  for (CoupledSide& side : sides_) side.answer.resize(0);
  for (int tried = 0; tried < most; ++tried) {
    for (const CoupledSide& side : sides_) side.set(loads_);
    if (!window.go()) {
      if (tried == 0) {
        window.go_back();
        return false;
      }
      loads_ = 0.5 * (loads_ + bearable);  // a guess that the structure cannot bear
      continue;
    }
    bearable = loads_;
    const VectorXd answer = ask(window.about(tried));
    if (is_enough(answer)) {
      accept(window, tried + 1);
      loads_ = answer;
      scheme_->end_window();
      return true;
    }
    misses.push_back((answer - loads_).norm());
    loads_ = scheme_->next(loads_, answer);
  }
  cut(window, misses);
  loads_ = first;
  return true;
}

bool CoupledRun::repeat_in_parallel(CoupledWindow& window) {
  const int most = settings_.integer("Most Attempts");
  const VectorXd first = loads_;
  CoupledGuess guess = {loads_, window.foreseen()};
  VectorXd bearable;
  std::vector<double> misses;
  for (CoupledSide& side : sides_) side.answer.resize(0);
  for (int tried = 0; tried < most; ++tried) {
    for (coupling::Window& motion : guess.motions) motion.attempt = tried;
    loads_ = guess.loads;
    for (const CoupledSide& side : sides_) side.set(loads_);
    pose(guess.motions);
    const bool is_bearable = window.go();
    const VectorXd answer = collect(guess.motions);
    if (!is_bearable) {
      if (tried == 0) {
        window.go_back();
        return false;
      }
      guess.loads = 0.5 * (loads_ + bearable);
      continue;
    }
    bearable = loads_;
    CoupledGuess found = {answer, window.about(tried)};
    if (is_enough(answer) && is_foreseen(window, guess, found)) {
      accept(window, tried + 1);
      loads_ = answer;
      scheme_->end_window();
      scale_.end_window();
      return true;
    }
    misses.push_back((answer - loads_).norm());
    guess = improve(*scheme_, scale_, sides_, guess, found);
  }
  cut(window, misses);
  loads_ = first;
  scale_.end_window();
  return true;
}

// Partners know nothing of attempts, so a shorter window begins where this one did.
void CoupledRun::cut(CoupledWindow& window, const std::vector<double>& misses) {
  attempts_ += static_cast<int>(misses.size());
  scheme_->drop_window();
  if (!window.cut()) give_up(window, misses);
}

// Lets all partners begin, so that those in other processes work at the same time.
void CoupledRun::pose(const std::vector<coupling::Window>& asked) {
  on_root(comm_, [&] {
    for (std::size_t i = 0; i < sides_.size(); ++i) sides_[i].partner->pose(asked[i]);
  });
}

VectorXd CoupledRun::collect(const std::vector<coupling::Window>& asked) {
  VectorXd answer(loads_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    CoupledSide& side = sides_[i];
    const coupling::Window& about = asked[i];
    VectorXd own(side.count());
    on_root(comm_, [&] {
      own = side.partner->loads(about);
      side.expect(coupling::objection_to(own, side.port->size()), about);
    });
    if (comm_.size() > 1) comm_.broadcast({own.data(), static_cast<std::size_t>(own.size())});
    side.put(std::move(own), answer);
    // how much of a change of motion comes back as load, for what rounding of motion makes of it
    const VectorXd moved = as_vector(about.of(port::Quantity::motion));
    const VectorXd scaled = answer.segment(side.first, side.count());
    if (side.answer.size() > 0) {
      const double change = (moved - side.moved).norm();
      constexpr double rounding = 1e4 * std::numeric_limits<double>::epsilon();
      if (change > rounding * as_vector(side.port->reference()).norm()) {
        side.stiffness = std::max(side.stiffness, (scaled - side.answer).norm() / change);
      }
    }
    side.acted = loads_.segment(side.first, side.count());
    side.moved = moved;
    side.answer = scaled;
  }
  return answer;
}

VectorXd CoupledRun::ask(const std::vector<coupling::Window>& asked) {
  pose(asked);
  return collect(asked);
}

// What is asked for, and what rounding of positions makes of loads.
bool CoupledRun::is_enough(const VectorXd& answer) const {
  return std::all_of(sides_.begin(), sides_.end(), [&](const CoupledSide& side) {
    const auto own = answer.segment(side.first, side.count());
    const auto before = loads_.segment(side.first, side.count());
    const double floor = round_off * as_vector(side.port->reference()).norm() * side.stiffness;
    return (own - before).norm() <= settings_.number("Tolerance") * own.norm() + floor;
  });
}

// Whether partners have answered the motion that the structure makes: to the tolerance, and so that
// the answer to the difference would be within that of the loads.
bool CoupledRun::is_foreseen(const CoupledWindow& window, const CoupledGuess& guess,
                             const CoupledGuess& found) const {
  const double tolerance = settings_.number("Tolerance");
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const CoupledSide& side = sides_[i];
    const double floor = round_off * as_vector(side.port->reference()).norm();
    const auto size = [&](port::Quantity q) { return as_vector(found.motions[i].of(q)).norm(); };
    const auto miss = [&](port::Quantity q) {
      return (as_vector(found.motions[i].of(q)) - as_vector(guess.motions[i].of(q))).norm();
    };
    for (const port::Quantity q : coupling::all_quantities) {
      if ((side.wanted & bit(q)) == 0) continue;
      const bool is_rate = q == port::Quantity::velocity || q == port::Quantity::acceleration;
      double rounding = q == port::Quantity::rotation ? floor / side.size : floor;
      if (is_rate) rounding *= 2.0 / window.shortest_step();
      if (q == port::Quantity::acceleration) rounding *= 2.0 / window.shortest_step();
      if (miss(q) > tolerance * size(is_rate ? q : port::Quantity::motion) + rounding) return false;
    }
    const double own = found.loads.segment(side.first, side.count()).norm();
    if (side.stiffness * miss(port::Quantity::motion) > tolerance * own + floor * side.stiffness) {
      return false;
    }
  }
  return true;
}

// Windows of several steps are not probed: they would have to be made once more.
void CoupledRun::watch(CoupledWindow& window, const std::vector<coupling::Window>& asked,
                       const VectorXd& answer) {
  const auto acceleration = [&](std::size_t i, const coupling::Window& motion) {
    return VectorXd((translations(motion.of(port::Quantity::velocity)) - sides_[i].velocity) /
                    window.length());
  };
  std::vector<VectorXd> made;
  const std::vector<coupling::Window> motions = window.about(0);
  for (std::size_t i = 0; i < sides_.size(); ++i) made.push_back(acceleration(i, motions[i]));
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    CoupledSide& side = sides_[i];
    const VectorXd own = side.loads(answer);
    side.loose.add(translations({own.begin(), own.end()}), acceleration(i, asked[i]));
    const VectorXd probe = window.has_steps() ? VectorXd() : side.loose.probe();
    if (probe.size() > 0) {
      VectorXd loads = loads_;
      VectorXd more = VectorXd::Zero(side.count());
      more.reshaped(6, side.count() / 6).topRows<3>() = probe.reshaped(3, side.count() / 6);
      side.put(side.loads(loads_) + more, loads);
      side.set(loads);
      const double end = window.end();
      if (window.go() && window.end() == end) {
        side.loose.measure(probe, acceleration(i, window.about(0)[i]) - made[i]);
      }
      side.set(loads_);
      window.go();  // as it was, bit by bit
    }
    if (const std::string danger = side.loose.warning(); !danger.empty()) {
      if (side.danger.empty()) side.danger = danger;
      findings_.warn("loose coupling", "partner '" + side.name + "': " + danger, window.start());
    }
  }
}

// Where loads and answer differ most.
std::string CoupledRun::worst_point() const {
  const CoupledSide* worst = nullptr;
  Eigen::Index place = 0;
  double most = -1.0;
  for (const CoupledSide& side : sides_) {
    if (side.answer.size() == 0) continue;
    const VectorXd miss = side.answer - side.acted;
    Eigen::Index i = 0;
    const double size = miss.cwiseAbs().maxCoeff(&i);
    if (size > most) {
      most = size;
      place = i;
      worst = &side;
    }
  }
  if (worst == nullptr) return "there was no answer";
  return fmt::format("'{}' answers {:.6g} for {:.6g} at point {} of port '{}', component {}",
                     worst->name, worst->answer[place], worst->acted[place], place / 6,
                     worst->port_name, place % 6);
}

void CoupledRun::give_up(const CoupledWindow& window, const std::vector<double>& misses) const {
  const bool is_robust = settings_.text("Scheme") == "Quasi Newton";
  std::string text = fmt::format(
      "Structure and partners did not agree in {} attempts of the window from {:g} s to {:g} s; "
      "{}.\n",
      settings_.integer("Most Attempts"), window.start(), window.end(), worst_point());
  if (cuts_.count > 0) {
    text += fmt::format("Windows were cut back {} times, down to {:g} s, where they disagreed.\n",
                        cuts_.count, cuts_.shortest);
  }
  if (!is_falling(misses)) {
    text +=
        "What they differ by does not fall from attempt to attempt, so that more of them are of "
        "no use.\n"
        "Likely cause: the partner's answer depends on more than the motion that it is asked "
        "for, such as on attempts before; or it has another sign or size than it should.\n";
  }
  text += fmt::format("Try: {}{}",
                      is_robust ? "" : "'Scheme' = Quasi Newton, which is the most robust one, ",
                      is_falling(misses) ? "more 'Most Attempts', " : "");
  throw NumericalError(text +
                       "a larger 'Tolerance', a smaller 'Step' or 'Window'; or the loads "
                       "grow with the motion, as in flutter.");
}

}  // namespace culm::simulation
