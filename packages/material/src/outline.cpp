#include <culm/material/outline.hpp>

#include <algorithm>

namespace culm::material {

namespace {

// Positive if counter-clockwise.
double twice_area(const std::vector<Vec<2>>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<2>& a = corners[i];
    const Vec<2>& b = corners[(i + 1) % corners.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

}  // namespace

Schema outline_schema() {
  return Schema("")
      .add(numbers("Outline", "m",
                   "Corners of the section for pictures, two coordinates each along its own d1 and "
                   "d2, in order; no part in the mechanics.")
               .min_size(6)
               .size_multiple_of(2)
               .optional())
      .check([](const Options& options, InputIssues& issues) {
        if (options.has("Outline") && twice_area(read_outline(options)) == 0.0) {
          issues.add(options.where("Outline"), "encloses no area");
        }
      });
}

std::vector<Vec<2>> read_outline(const Options& options) {
  if (!options.has("Outline")) return {};
  std::vector<Vec<2>> corners;
  const std::vector<double>& values = options.numbers("Outline");
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    corners.emplace_back(values[i], values[i + 1]);
  }
  if (twice_area(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace culm::material
