#include <culm/base/error.hpp>
#include <culm/base/number_file.hpp>
#include <culm/base/schema.hpp>
#include <culm/base/text.hpp>

#include "polar_row.hpp"
#include "types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::strip {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
// by which a polar may miss its ends and itself at both of them: the digits of files
constexpr double closing_angle = 1e-3;
constexpr double closing_coefficient = 0.05;

// Linear between the rows of a table.
class Polar final : public Airfoil {
 public:
  explicit Polar(std::vector<PolarRow> rows) : rows_(std::move(rows)) {
    std::vector<LiftPoint> lift;
    for (const PolarRow& row : rows_) lift.push_back({row.alpha, row.coefficients[0]});
    separation_ = find_separation(lift);
    cells_.resize(2 * rows_.size());
    cells_per_radian_ =
        static_cast<double>(cells_.size()) / (rows_.back().alpha - rows_.front().alpha);
    std::size_t above = 1;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double begin = rows_.front().alpha + static_cast<double>(i) / cells_per_radian_;
      while (above + 1 < rows_.size() && rows_[above].alpha <= begin) ++above;
      cells_[i] = above;
    }
  }

  Coefficients at(double alpha, Coefficients& slope) const override {
    const std::size_t above = above_of(alpha);
    const PolarRow& high = rows_[above];
    const PolarRow& low = rows_[above - 1];
    slope = (high.coefficients - low.coefficients) / (high.alpha - low.alpha);
    return low.coefficients + (alpha - low.alpha) * slope;
  }
  const Separation* separation() const override { return separation_ ? &*separation_ : nullptr; }

 private:
  // The first row above an angle, or the last one; the second one below them all.
  std::size_t above_of(double alpha) const {
    const double cell = (alpha - rows_.front().alpha) * cells_per_radian_;
    if (!(cell > 0.0)) return 1;
    const auto last = static_cast<double>(cells_.size() - 1);
    std::size_t above = cells_[static_cast<std::size_t>(std::min(cell, last))];
    while (above + 1 < rows_.size() && rows_[above].alpha <= alpha) ++above;
    while (above > 1 && rows_[above - 1].alpha > alpha) --above;  // by rounding of the cell
    return above;
  }

  std::vector<PolarRow> rows_;
  std::vector<std::size_t> cells_;  // of one size each: the first row above its begin
  double cells_per_radian_ = 0.0;
  std::optional<Separation> separation_;
};

std::string mistake(const std::vector<PolarRow>& rows) {
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

std::vector<PolarRow> read_csv(const std::string& name, const Where& where, std::string& path) {
  std::vector<PolarRow> rows;
  InputIssues issues;
  path = read_number_lines(name, where, [&](const NumberLine& line) {
    if (line.numbers.size() != 4) {
      issues.add(line.where, "must be 'angle in degrees, lift, drag, moment', got '" +
                                 shortened(line.text, 60) + "'");
      return;
    }
    rows.push_back({line.numbers[0] * degree, {line.numbers[1], line.numbers[2], line.numbers[3]}});
  });
  issues.throw_if_any();
  return rows;
}

SharedAirfoil make_from_file(const Options& options) {
  const Where& where = options.where("File Name");
  const std::string& name = options.text("File Name");
  std::string path;
  std::vector<PolarRow> rows = options.text("File Format") == "AeroDyn"
                                   ? read_aerodyn_polar(name, where, path)
                                   : read_csv(name, where, path);
  if (const std::string wrong = mistake(rows); !wrong.empty())
    throw InputError({path, 0, {}}, wrong);
  return std::make_shared<Polar>(std::move(rows));
}

constexpr const char* columns[] = {"Lift", "Drag", "Moment"};

std::vector<PolarRow> rows_of(const Options& options) {
  const std::vector<double>& angles = options.numbers("Angles");
  std::vector<PolarRow> rows;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    PolarRow row{angles[i], Coefficients::Zero()};
    for (int k = 0; k < 3; ++k) {
      if (options.has(columns[k])) row.coefficients[k] = options.numbers(columns[k])[i];
    }
    rows.push_back(row);
  }
  return rows;
}

SharedAirfoil make(const Options& options) {
  if (options.has("File Name")) return make_from_file(options);
  return std::make_shared<Polar>(rows_of(options));
}

void check_polar(const Options& options, InputIssues& issues) {
  if (options.has("File Name") == options.has("Angles")) {
    issues.add(options.where(), "give one of 'File Name' and 'Angles'");
    return;
  }
  if (options.has("Angles") != options.has("Lift")) {
    issues.add(options.where(), "'Angles' and 'Lift' need each other");
    return;
  }
  bool whole = true;
  for (const char* column : columns) {
    if (!options.has(column)) continue;
    if (!options.has("Angles")) {
      issues.add(options.where(column), "stands in the file");
      return;
    }
    const std::size_t expected = options.numbers("Angles").size();
    const std::size_t count = options.numbers(column).size();
    if (count == expected) continue;
    whole = false;
    issues.add(options.where(column),
               fmt::format("must have one value for each of {} angles, got {}", expected, count));
  }
  if (!whole || !options.has("Angles")) return;
  if (const std::string wrong = mistake(rows_of(options)); !wrong.empty())
    issues.add(options.where("Angles"), wrong);
}

}  // namespace

void register_polar(AirfoilRegistry& registry) {
  registry.add(
      "Polar",
      Schema("Polar", "Coefficients by a table over all angles, linear in between.")
          .add(text("File Name",
                    "Lines 'angle in degrees, lift, drag, moment', from -180 to 180 degrees; the "
                    "moment is about the quarter chord, nose up.")
                   .optional())
          .add(choice("File Format", {"CSV", "AeroDyn"},
                      "Numbers with commas, or a file of an airfoil for AeroDyn.")
                   .optional("CSV"))
          .add(numbers("Angles", "rad", "Rising from -180 to 180 degrees, in place of a file.")
                   .min_size(3)
                   .optional())
          .add(numbers("Lift", "1", "Coefficients at the angles.").optional())
          .add(numbers("Drag", "1", "The same of the drag; zero if absent.").optional())
          .add(numbers("Moment", "1",
                       "The same of the moment about the quarter chord, nose up; zero if absent.")
                   .optional())
          .check(check_polar),
      make);
}

}  // namespace culm::strip
