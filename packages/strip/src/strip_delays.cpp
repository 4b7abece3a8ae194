#include "section_forces.hpp"
#include "strip_tangent.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

namespace culm::strip {

PerStateKind StripLoad::times_of(std::size_t number, const model::State& state) const {
  constexpr double distance = 1e-4;  // relative, below which times are moved apart
  const Station& station = stations_[number];
  PerStateKind times;
  times.fill(std::numeric_limits<double>::infinity());
  const double speed =
      evaluate<double>(number, state, Stencil::linearisation(), Want::residual).end.seen.speed;
  if (!(speed > 0.0)) return times;  // no wind, no load
  for (std::size_t k = 0; k < static_cast<std::size_t>(model_.lag.states); ++k) {
    times[state_kind::first_lag + k] = lag_time(model_.lag, k, 0.5 * station.chord, speed);
  }
  const bool stalls = station.airfoil->separation() != nullptr ||
                      (station.blend > 0.0 && station.next_airfoil->separation() != nullptr);
  if (model_.stall != Stall::none && stalls) {
    const bool four = model_.stall == Stall::four_states;
    if (four) times[state_kind::pressure] = pressure_time(station.chord, speed);
    times[state_kind::attached] = attached_time(model_.stall, station.chord, speed);
  }
  if (induced_[number].slow_time > 0.0) {
    times[state_kind::slow_inflow] = induced_[number].slow_time;
    times[state_kind::fast_inflow] = induced_[number].fast_time;
  }
  for (std::size_t k = 1; k < times.size(); ++k) {
    const auto others = std::span(times).first(k);
    while (std::isfinite(times[k]) && std::ranges::any_of(others, [&](double other) {
             return std::abs(other - times[k]) < distance * times[k];
           })) {
      times[k] *= 1.0 + 2.0 * distance;
    }
  }
  return times;
}

std::vector<double> StripLoad::delays(const model::State& state) const {
  std::vector<double> all;
  for (const int item : placement().items) {
    std::ranges::copy_if(times_of(static_cast<std::size_t>(item), state), std::back_inserter(all),
                         [](double time) { return std::isfinite(time); });
  }
  return all;
}

// The forces are affine in 1 / (1 + s T_k) of each kind k, so the factor of that of one of them is
// found where the others have the values T_k / (T_k - T_j) that they take at its pole.
Verdict StripLoad::assemble_delayed(const model::State& state, const Stencil& stencil, double delay,
                                    model::Target& target) {
  return assemble_items([&](auto space, std::size_t i) {
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const PerStateKind times = times_of(number, state);
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (!(std::abs(times[k] - delay) <= model::same_delay * delay)) continue;
      PerStateKind follow = all_follow;
      for (std::size_t j = 0; j < times.size(); ++j) {
        if (j != k && std::isfinite(times[j])) follow[j] = times[k] / (times[k] - times[j]);
      }
      constexpr Want want = Want::residual_and_tangent;
      const Evaluation all = evaluate<Dual>(number, state, stencil, want, follow);
      follow[k] = 0.0;
      Evaluation gained = evaluate<Dual>(number, state, stencil, want, follow);
      gained.derivative -= all.derivative;
      if (!gained.derivative.allFinite()) return Verdict::not_finite;
      add_tangent<decltype(space)>(i, gained, state, stencil.theta, false, target);
    }
    return Verdict::ok;
  });
}

}  // namespace culm::strip
