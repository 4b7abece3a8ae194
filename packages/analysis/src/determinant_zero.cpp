#include "determinant_zero.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace culm::analysis {
namespace {

// An end of the interval in which the zero lies.
struct End {
  double place = 0.0, value = 0.0;
  double weight = 1.0;  // of the value; Illinois takes half of it where an end stays
};

double zero_between(const End& near, const End& far) {
  const double a = near.weight * near.value, b = far.weight * far.value;
  return near.place + a / (a - b) * (far.place - near.place);
}

}  // namespace

DeterminantZero approach_zero(const DeterminantAt& start, const DeterminantAt& end,
                              const std::function<std::optional<solver::Determinant>(double)>& at) {
  const auto relative = [&](const solver::Determinant& d) {
    return d.sign * std::exp(std::clamp(d.log_size - start.determinant.log_size, -600.0, 600.0));
  };
  End near{start.place, relative(start.determinant)}, far{end.place, relative(end.determinant)};
  const double length = end.place - start.place;
  constexpr int most_points = 20, most_failures = 8;
  constexpr double close = 1e-6;  // over the length, and over the smaller determinant
  const double small = close * std::min(std::abs(near.value), std::abs(far.value));
  int same_side = 0, failures = 0;
  std::optional<std::pair<double, double>> gap;  // between places without a determinant
  bool is_found = false;
  for (int i = 0; i < most_points && failures < most_failures && !is_found; ++i) {
    double place = 0.5 * (near.place + far.place);
    if (gap) {
      const bool is_before = gap->first - near.place > far.place - gap->second;
      place = 0.5 * (is_before ? near.place + gap->first : gap->second + far.place);
    } else if (std::abs(same_side) <= 2) {
      const double margin = 0.01 * (far.place - near.place);
      place = std::clamp(zero_between(near, far), near.place + margin, far.place - margin);
    }
    const std::optional<solver::Determinant> determinant = at(place);
    if (!determinant) {
      ++failures;
      gap = gap ? std::minmax({gap->first, gap->second, place}) : std::pair(place, place);
      continue;
    }
    const double value = relative(*determinant);
    if (value * near.value > 0.0) {
      near = {place, value};
      same_side = std::max(same_side, 0) + 1;
      far.weight = same_side > 1 ? 0.5 * far.weight : far.weight;
    } else {
      far = {place, value};
      same_side = std::min(same_side, 0) - 1;
      near.weight = same_side < -1 ? 0.5 * near.weight : near.weight;
    }
    if (gap && (gap->first < near.place || gap->first > far.place)) gap.reset();
    is_found = std::abs(value) < small || far.place - near.place <= close * length;
  }
  near.weight = far.weight = 1.0;
  return {zero_between(near, far), near.place, far.place, is_found};
}

}  // namespace culm::analysis
