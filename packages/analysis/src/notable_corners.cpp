#include "notable_corners.hpp"

#include <algorithm>
#include <cmath>

namespace culm::analysis {
namespace {

constexpr double notable = 0.01;  // of the largest value at corners

std::vector<double> corners_of(const model::Amplitude& function) {
  const std::vector<double>& times = function.corners();
  if (times.size() < 3 || !function.is_function_of_time()) return times;
  std::vector<double> before, after;  // functions may jump
  double size = 0.0;
  for (const double time : times) {
    before.push_back(function.at(std::nextafter(time, -HUGE_VAL)));
    after.push_back(function.at(std::nextafter(time, HUGE_VAL)));
    size = std::max({size, std::abs(before.back()), std::abs(after.back())});
  }
  std::vector<double> found{times.front()};
  for (std::size_t i = 1; i + 1 < times.size(); ++i) {
    const double share = (times[i] - times[i - 1]) / (times[i + 1] - times[i - 1]);
    const double line = (1.0 - share) * after[i - 1] + share * before[i + 1];
    const double away = std::max(std::abs(before[i] - line), std::abs(after[i] - line));
    if (away > notable * size) found.push_back(times[i]);
  }
  found.push_back(times.back());
  return found;
}

}  // namespace

std::vector<double> notable_corners(const std::map<std::string, model::Amplitude>& functions) {
  std::vector<double> all;
  for (const auto& [name, function] : functions) {
    const std::vector<double> own = corners_of(function);
    all.insert(all.end(), own.begin(), own.end());
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace culm::analysis
