#include <culm/analysis/path_events.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::analysis {
namespace {

// The cubic with given values and slopes at 0 and h.
struct Cubic {
  double v0, v1, s0, s1, h;

  double at(double x) const {
    const double t = x / h;
    const double u = 1.0 - t;
    return u * u * ((1.0 + 2.0 * t) * v0 + t * h * s0) +
           t * t * ((3.0 - 2.0 * t) * v1 - u * h * s1);
  }
  double slope(double x) const {
    const double t = x / h;
    const double u = 1.0 - t;
    return 6.0 * t * u * (v1 - v0) / h + u * (1.0 - 3.0 * t) * s0 - t * (2.0 - 3.0 * t) * s1;
  }
  // Where the slope, a parabola, has its extreme; within the ends if it turns twice.
  double steepest() const {
    const double mean = (v1 - v0) / h;
    return h * std::clamp((3.0 * mean - 2.0 * s0 - s1) / (3.0 * (2.0 * mean - s0 - s1)), 0.0, 1.0);
  }
  bool turns() const { return s0 * s1 < 0.0; }
  // there and back between the ends
  bool turns_twice() const { return s0 * s1 > 0.0 && (v1 - v0) * s0 < 0.0; }
  // where it turns, by bisection
  double turning_point() const { return turning_point(0.0, h); }
  double turning_point(double low, double high) const {
    const double first = slope(low);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (slope(middle) * first > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

}  // namespace

std::string name_of(PathEventKind kind) {
  switch (kind) {
    case PathEventKind::limit_point:
      return "limit point";
    case PathEventKind::turning_point:
      return "turning point";
    case PathEventKind::bifurcation:
      return "bifurcation";
  }
  return {};
}

std::vector<PathEvent> find_events(const PathPoint& from, const PathPoint& to, double length) {
  const Cubic level{from.level, to.level, from.tangent.level, to.tangent.level, length};
  const Cubic watched{from.watched, to.watched, from.tangent.watched, to.tangent.watched, length};
  std::vector<std::pair<double, PathEventKind>> found;
  if (level.turns()) found.emplace_back(level.turning_point(), PathEventKind::limit_point);
  if (level.turns_twice()) {
    // between them the slope is that of the secant at least once
    const double middle = level.steepest();
    found.emplace_back(level.turning_point(0.0, middle), PathEventKind::limit_point);
    found.emplace_back(level.turning_point(middle, length), PathEventKind::limit_point);
  }
  if (watched.turns()) found.emplace_back(watched.turning_point(), PathEventKind::turning_point);
  const solver::Determinant &d0 = from.determinant, &d1 = to.determinant;
  const bool are_known = d0.sign != 0 && d1.sign != 0;
  if (are_known && (d0.sign != d1.sign) != level.turns()) {
    // the determinant is linear between the points; if it has two zeros all that is known is that
    // they lie there
    const double share =
        d0.sign != d1.sign ? 1.0 / (1.0 + std::exp(d1.log_size - d0.log_size)) : 0.5;
    found.emplace_back(share * length, PathEventKind::bifurcation);
  }
  std::sort(found.begin(), found.end());
  std::vector<PathEvent> events;
  for (const auto& [x, kind] : found) events.push_back({kind, level.at(x), watched.at(x), x});
  return events;
}

}  // namespace culm::analysis
