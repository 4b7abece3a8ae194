#include <culm/base/error.hpp>
#include <culm/base/number_file.hpp>
#include <culm/base/text.hpp>

#include "vector_fields.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace culm::model {
namespace {

constexpr std::size_t dimensions = 4;  // t, x, y, z

// Where a coordinate lies between the values of an axis.
struct Bracket {
  std::size_t lower = 0, upper = 0;
  double share = 0.0;  // of the upper one
  double slope = 0.0;  // d share / d coordinate; 0 beyond the ends
};

Bracket find(const std::vector<double>& axis, double at) {
  const auto after = std::upper_bound(axis.begin(), axis.end(), at);
  if (after == axis.begin()) return {};
  const auto upper = static_cast<std::size_t>(after - axis.begin());
  if (after == axis.end()) return {upper - 1, upper - 1, 0.0, 0.0};
  const double width = axis[upper] - axis[upper - 1];
  return {upper - 1, upper, (at - axis[upper - 1]) / width, 1.0 / width};
}

// Linear along each axis between the points of a regular grid.
class GridField final : public VectorField {
 public:
  using Axes = std::array<std::vector<double>, dimensions>;

  /// @param vectors  the last axis runs fastest
  GridField(Axes axes, std::vector<Vec3> vectors)
      : axes_(std::move(axes)), vectors_(std::move(vectors)) {}

  Vec3 value(const Vec3& place, double time) const override {
    return sum(brackets(place, time), dimensions);
  }
  bool varies_in_time() const override { return axes_[0].size() > 1; }
  Mat3 gradient(const Vec3& place, double time) const override {
    const auto found = brackets(place, time);
    Mat3 gradient;
    for (std::size_t j = 0; j < 3; ++j) gradient.col(static_cast<int>(j)) = sum(found, j + 1);
    return gradient;
  }

 private:
  std::array<Bracket, dimensions> brackets(const Vec3& place, double time) const {
    return {find(axes_[0], time), find(axes_[1], place[0]), find(axes_[2], place[1]),
            find(axes_[3], place[2])};
  }

  // Over the corners of a cell, or their derivative along one axis.
  Vec3 sum(const std::array<Bracket, dimensions>& found, std::size_t derived) const {
    Vec3 total = Vec3::Zero();
    for (unsigned corner = 0; corner < (1U << dimensions); ++corner) {
      double weight = 1.0;
      std::size_t index = 0;
      for (std::size_t d = 0; d < dimensions; ++d) {
        const bool is_upper = (corner >> d & 1U) != 0;
        const Bracket& one = found[d];
        if (d == derived) {
          weight *= is_upper ? one.slope : -one.slope;
        } else {
          weight *= is_upper ? one.share : 1.0 - one.share;
        }
        index = index * axes_[d].size() + (is_upper ? one.upper : one.lower);
      }
      if (weight != 0.0) total += weight * vectors_[index];
    }
    return total;
  }

  Axes axes_;
  std::vector<Vec3> vectors_;
};

using Point = std::pair<std::array<double, dimensions>, Vec3>;

std::vector<Point> read_points(const Options& options, std::string& path) {
  std::vector<Point> points;
  InputIssues issues;
  const auto take = [&](const NumberLine& line) {
    const std::vector<double>& n = line.numbers;
    if (n.size() != 6 && n.size() != 7) {
      issues.add(line.where, "must be 'x, y, z' or 't, x, y, z' and the three components, got '" +
                                 shortened(line.text, 60) + "'");
      return;
    }
    const std::size_t first = n.size() - 6;
    points.push_back({{first == 1 ? n[0] : 0.0, n[first], n[first + 1], n[first + 2]},
                      Vec3(n[first + 3], n[first + 4], n[first + 5])});
  };
  path = read_number_lines(options.text("File Name"), options.where("File Name"), take);
  if (points.empty() && issues.empty()) issues.add({path, 0, {}}, "holds no points");
  issues.throw_if_any();
  return points;
}

SharedField make(const Options& options) {
  std::string path;
  std::vector<Point> points = read_points(options, path);
  GridField::Axes axes;
  std::size_t size = 1;
  for (std::size_t d = 0; d < dimensions; ++d) {
    for (const Point& point : points) axes[d].push_back(point.first[d]);
    std::ranges::sort(axes[d]);
    axes[d].erase(std::unique(axes[d].begin(), axes[d].end()), axes[d].end());
    size *= axes[d].size();
  }
  const auto coordinates = [](const Point& point) { return point.first; };
  std::ranges::sort(points, {}, coordinates);
  const auto twice = std::ranges::adjacent_find(points, {}, coordinates);
  if (size != points.size() || twice != points.end()) {
    throw InputError(options.where("File Name"),
                     "'" + path + "' holds " + std::to_string(points.size()) +
                         " points, which are no grid: " + std::to_string(axes[0].size()) +
                         " times, " + std::to_string(axes[1].size()) + " x, " +
                         std::to_string(axes[2].size()) + " y and " +
                         std::to_string(axes[3].size()) + " z want each combination once");
  }
  std::vector<Vec3> vectors;
  for (const Point& point : points) vectors.push_back(point.second);
  return std::make_shared<GridField>(std::move(axes), std::move(vectors));
}

}  // namespace

void register_grid_field(FieldRegistry& registry) {
  registry.add("Grid",
               Schema("Grid",
                      "Linear between the points of a grid, as at its border beyond; from a file "
                      "with lines 'x, y, z' or 't, x, y, z' and three components.")
                   .add(text("File Name", "CSV file, relative to the deck.")),
               make);
}

}  // namespace culm::model
