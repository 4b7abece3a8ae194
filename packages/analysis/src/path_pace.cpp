#include <culm/analysis/path_pace.hpp>

#include <cmath>
#include <limits>

namespace culm::analysis {

void PathPace::add(double level, double watched) {
  levels_.push_back(level);
  watched_.push_back(watched);
  if (levels_.size() > steps + 1) {
    levels_.erase(levels_.begin());
    watched_.erase(watched_.begin());
  }
}

std::optional<double> PathPace::steps_to(const std::vector<double>& points, double target) {
  if (points.size() < steps + 1) return {};
  const double left = std::abs(target - points.back());
  const double gained = std::abs(target - points.front()) - left;
  if (gained <= 0.0) return std::numeric_limits<double>::infinity();
  return std::ceil(left / gained * steps);
}

void PathPace::save(Snapshot& snapshot) const {
  snapshot.set("path/last levels", levels_);
  snapshot.set("path/last watched", watched_);
}

void PathPace::restore(const Snapshot& snapshot) {
  levels_ = snapshot.copy("path/last levels");
  watched_ = snapshot.copy("path/last watched");
}

}  // namespace culm::analysis
