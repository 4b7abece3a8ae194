#include <culm/analysis/failure_trend.hpp>

#include <array>
#include <cstddef>

namespace culm::analysis {
namespace {

// Gains are compared by groups, because single ones jump with the rules of the increment; three
// groups must shrink each to so much of the one before.
struct Pattern {
  std::size_t group;
  double shrinks_to;
};
// what collapses fast shows it in fewer gains
constexpr std::array<Pattern, 2> patterns{{{2, 1.0 / 3.0}, {4, 0.5}}};
constexpr std::size_t groups = 3;
constexpr std::size_t most_levels = groups * patterns.back().group + 1;

// The sum of the gains between the last levels if they go on to shrink; nothing if they do not.
std::optional<double> limit_of(const std::vector<double>& levels, const Pattern& pattern) {
  const std::size_t count = groups * pattern.group + 1;
  if (levels.size() < count) return {};
  const auto begin = levels.end() - static_cast<std::ptrdiff_t>(count);
  std::array<double, groups> gains{};
  for (std::size_t i = 0; i < groups; ++i) {
    const auto first = begin + static_cast<std::ptrdiff_t>(pattern.group * i);
    gains.at(i) = first[static_cast<std::ptrdiff_t>(pattern.group)] - *first;
  }
  double ratio = 0.0;
  for (std::size_t i = 1; i < groups; ++i) {
    ratio = gains.at(i) / gains.at(i - 1);
    if (ratio > pattern.shrinks_to) return {};
  }
  return levels.back() + gains.back() * ratio / (1.0 - ratio);
}

}  // namespace

void FailureTrend::add(double level) {
  if (!levels_.empty() && level <= levels_.back()) return;
  levels_.push_back(level);
  if (levels_.size() > most_levels) levels_.erase(levels_.begin());
}

std::optional<double> FailureTrend::end(double final_level) const {
  for (const Pattern& pattern : patterns) {
    const std::optional<double> end = limit_of(levels_, pattern);
    if (end && *end < final_level) return end;
  }
  return {};
}

void FailureTrend::save(Snapshot& snapshot) const { snapshot.set("statics/failures", levels_); }

void FailureTrend::restore(const Snapshot& snapshot) {
  levels_ = snapshot.copy("statics/failures");
}

}  // namespace culm::analysis
