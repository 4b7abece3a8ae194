#include <culm/base/error.hpp>
#include <culm/base/number_file.hpp>
#include <culm/base/schema.hpp>
#include <culm/base/text.hpp>

#include "types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace culm::strip {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
// by which a polar may miss its ends and itself at both of them: the digits of files
constexpr double closing_angle = 1e-3;
constexpr double closing_coefficient = 0.05;

struct Row {
  double alpha;  // [rad]
  Coefficients coefficients;
};

// Linear between the rows of a table.
class Polar final : public Airfoil {
 public:
  explicit Polar(std::vector<Row> rows) : rows_(std::move(rows)) {}

  Coefficients at(double alpha, Coefficients& slope) const override {
    const auto above =
        std::upper_bound(rows_.begin() + 1, rows_.end() - 1, alpha,
                         [](double angle, const Row& row) { return angle < row.alpha; });
    const Row& high = *above;
    const Row& low = *(above - 1);
    slope = (high.coefficients - low.coefficients) / (high.alpha - low.alpha);
    return low.coefficients + (alpha - low.alpha) * slope;
  }

 private:
  std::vector<Row> rows_;
};

std::string mistake(const std::vector<Row>& rows) {
  if (rows.size() < 3)
    return fmt::format("a polar needs at least three angles, got {}", rows.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].alpha > rows[i - 1].alpha) continue;
    return fmt::format("angles must rise, got {:g} after {:g} degrees", rows[i].alpha / degree,
                       rows[i - 1].alpha / degree);
  }
  if (std::abs(rows.front().alpha + std::numbers::pi) > closing_angle ||
      std::abs(rows.back().alpha - std::numbers::pi) > closing_angle) {
    return fmt::format("a polar must reach from -180 to 180 degrees, got {:g} to {:g}",
                       rows.front().alpha / degree, rows.back().alpha / degree);
  }
  const Coefficients gap = rows.back().coefficients - rows.front().coefficients;
  if (gap.lpNorm<Eigen::Infinity>() > closing_coefficient) {
    return fmt::format(
        "a polar must have the same coefficients at -180 and 180 degrees, they differ by {:g}",
        gap.lpNorm<Eigen::Infinity>());
  }
  return {};
}

SharedAirfoil make(const Options& options) {
  std::vector<Row> rows;
  InputIssues issues;
  const Where& where = options.where("File Name");
  const std::string path =
      read_number_lines(options.text("File Name"), where, [&](const NumberLine& line) {
        if (line.numbers.size() != 4) {
          issues.add(line.where, "must be 'angle in degrees, lift, drag, moment', got '" +
                                     shortened(line.text, 60) + "'");
          return;
        }
        rows.push_back(
            {line.numbers[0] * degree, {line.numbers[1], line.numbers[2], line.numbers[3]}});
      });
  issues.throw_if_any();
  if (const std::string wrong = mistake(rows); !wrong.empty())
    throw InputError({path, 0, {}}, wrong);
  return std::make_shared<Polar>(std::move(rows));
}

}  // namespace

void register_polar(AirfoilRegistry& registry) {
  registry.add(
      "Polar",
      Schema("Polar", "Coefficients by a table over all angles, linear in between.")
          .add(text("File Name",
                    "Lines 'angle in degrees, lift, drag, moment', from -180 to 180 degrees; the "
                    "moment is about the quarter chord, nose up.")),
      make);
}

}  // namespace culm::strip
