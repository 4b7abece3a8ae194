#include <culm/rotor/dynamic_inflow.hpp>

#include <algorithm>
#include <cmath>

namespace culm::rotor {
namespace {

constexpr double k = 0.6;  // share of a change that skips the slow lag

}  // namespace

InflowTimes inflow_times(double mean_induction, double wind, double tip_radius,
                         double radius_ratio) {
  const double slow = 1.1 / (1.0 - 1.3 * std::clamp(mean_induction, 0.0, 0.5)) * tip_radius / wind;
  return {slow, (0.39 - 0.26 * radius_ratio * radius_ratio) * slow};
}

InflowState InflowState::steady(const Induced& quasi_steady) {
  return {(1.0 - k) * quasi_steady, quasi_steady};
}

// Both equations have a solution that is linear in time, as W_qs is; what differs from it dies out.
InflowState InflowState::after(double step, const InflowTimes& times, const Induced& begin,
                               const Induced& end) const {
  const Induced rate = (end - begin) / step;
  const Induced reduced_lag = (1.0 - k) * times.slow * rate;
  const Induced lag = reduced_lag + times.fast * rate;
  const Induced slow_part = reduced - ((1.0 - k) * begin - reduced_lag);
  const Induced carried = slow_part / (1.0 - times.fast / times.slow);
  const Induced fast_part = induced - (begin - lag) - carried;
  const double slow_left = std::exp(-step / times.slow);
  const double fast_left = std::exp(-step / times.fast);
  return {(1.0 - k) * end - reduced_lag + slow_left * slow_part,
          end - lag + slow_left * carried + fast_left * fast_part};
}

double slow_share(const InflowTimes& times) { return (1.0 - k) / (1.0 - times.fast / times.slow); }

// Of one that starts at zero: InflowState::after where begin = end = 1.
double inflow_response(double step, const InflowTimes& times) {
  const double carried = slow_share(times);
  return 1.0 - carried * std::exp(-step / times.slow) -
         (1.0 - carried) * std::exp(-step / times.fast);
}

}  // namespace culm::rotor
