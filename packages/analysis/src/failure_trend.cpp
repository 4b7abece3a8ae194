#include <culm/analysis/failure_trend.hpp>

#include <cstddef>

namespace culm::analysis {
namespace {

// Gains are compared by groups, because single ones jump with the rules of the increment; three
// groups must shrink each to so much of the one before.
constexpr std::size_t group = 4;
constexpr std::size_t groups = 3;
constexpr double shrinks_to = 0.5;

}  // namespace

void FailureTrend::add(double level) {
  if (!levels_.empty() && level <= levels_.back()) return;
  levels_.push_back(level);
  if (levels_.size() > group * groups + 1) levels_.erase(levels_.begin());
}

std::optional<double> FailureTrend::end(double final_level) const {
  if (levels_.size() < group * groups + 1) return {};
  double gains[groups];
  for (std::size_t i = 0; i < groups; ++i) gains[i] = levels_[group * (i + 1)] - levels_[group * i];
  double ratio = 0.0;
  for (std::size_t i = 1; i < groups; ++i) {
    ratio = gains[i] / gains[i - 1];
    if (ratio > shrinks_to) return {};
  }
  const double end = levels_.back() + gains[groups - 1] * ratio / (1.0 - ratio);
  return end < final_level ? std::optional(end) : std::nullopt;
}

void FailureTrend::save(Snapshot& snapshot) const { snapshot.set("statics/failures", levels_); }

void FailureTrend::restore(const Snapshot& snapshot) {
  levels_ = snapshot.numbers("statics/failures");
}

}  // namespace culm::analysis
