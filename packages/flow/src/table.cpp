// Winds that vary in time, by the columns and formulas of OpenFAST's uniform wind files.
#include <culm/base/error.hpp>
#include <culm/base/number_file.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>

#include "reference_wind.hpp"
#include "tower_influence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

namespace culm::flow {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double half_turn = 180.0 + 1e-9;  // [degrees], with rounding

enum Column { at, speed, direction, vertical, across_shear, exponent, up_shear, gust, columns };
using Row = std::array<double, columns>;

// Linear between rows, held before the first and after the last; the later of equal times.
Row row_at(const std::vector<Row>& rows, double time) {
  const auto after =
      std::upper_bound(rows.begin(), rows.end(), time,
                       [](double moment, const Row& row) { return moment < row[at]; });
  if (after == rows.begin()) return rows.front();
  if (after == rows.end()) return rows.back();
  const Row& low = *(after - 1);
  const double share = (time - low[at]) / ((*after)[at] - low[at]);
  Row row;
  for (std::size_t c = 0; c < columns; ++c) row[c] = low[c] + share * ((*after)[c] - low[c]);
  return row;
}

// So that a motion tells what its steps do not see of the speed and of the direction.
void add_functions(const std::string& name, const std::vector<Row>& rows, model::Model& model) {
  std::vector<double> times;
  for (const Row& row : rows) {
    if (times.empty() || row[at] > times.back()) times.push_back(row[at]);
  }
  const auto add = [&](const char* what, auto value) {
    model.add_function(name + ", " + what, model::Amplitude::of_time([rows, value](double time) {
                                             return value(row_at(rows, time));
                                           }).with_corners(times));
  };
  add("speed", [](const Row& row) { return row[speed] + row[gust]; });
  add("direction", [](const Row& row) { return row[direction]; });
}

class Table final : public Flow {
 public:
  Table(const Options& options, std::vector<Row> rows)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        height_(options.number("Height")),
        length_(options.number("Length")),
        rows_(std::move(rows)) {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    const Row now = row_at(rows_, time);
    const Vec3 along = axes_.turned(now[direction]);
    const Vec3 across = axes_.up.cross(along).normalized();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double height = axes_.height(places[i]);
      const double shear =
          now[across_shear] * across.dot(places[i]) + now[up_shear] * (height - height_);
      const double ratio = power_law(height, height_, now[exponent]) + shear / length_;
      velocities[i] = (now[speed] * ratio + now[gust]) * along + now[vertical] * axes_.up;
    }
  }
  Mat3 gradient(const Vec3& place, double time) const override {
    const Row now = row_at(rows_, time);
    const Vec3 along = axes_.turned(now[direction]);
    const double slope = power_law_slope(axes_.height(place), height_, now[exponent]);
    const Vec3 ratio = (slope + now[up_shear] / length_) * axes_.up +
                       now[across_shear] / length_ * axes_.up.cross(along).normalized();
    return now[speed] * along * ratio.transpose();
  }

  bool is_above_ground(const Vec3& place) const override { return axes_.height(place) > 0.0; }

 private:
  WindAxes axes_;
  double height_, length_;
  std::vector<Row> rows_;
};

// Rows in the order of their times.
class Rows {
 public:
  void add(const Where& where, std::span<const double> numbers) {
    Row row;
    std::copy_n(numbers.begin(), columns, row.begin());
    row[direction] *= degree;
    if (!rows_.empty() && row[at] < rows_.back()[at])
      issues_.add(where, fmt::format("times must not fall, got {:g} s after {:g} s", row[at],
                                     rows_.back()[at]));
    check_turn(where, row);
    rows_.push_back(row);
  }
  void refuse(const Where& where, const std::string& expected, std::string_view line) {
    issues_.add(where, "must be " + expected + ", got '" + shortened(std::string(line), 60) + "'");
  }
  std::vector<Row> take(const std::string& path) {
    issues_.throw_if_any();
    if (rows_.empty()) throw InputError({path, 0, {}}, "a table of wind needs at least one line");
    return std::move(rows_);
  }

 private:
  // Linear in between, from 359 to 1 degrees a wind would go all the way round.
  void check_turn(const Where& where, const Row& row) {
    if (rows_.empty() || row[at] <= rows_.back()[at]) return;
    const double before = rows_.back()[direction] / degree, after = row[direction] / degree;
    if (std::abs(after - before) <= half_turn) return;
    issues_.add(
        where, fmt::format("from {:g} to {:g} degrees the wind would turn by more than half a turn "
                           "within a line: write {:g}, or a line in between where it does so",
                           before, after, before + std::remainder(after - before, 360.0)));
  }

  std::vector<Row> rows_;
  InputIssues issues_;
};

std::vector<Row> read_csv(const Options& options) {
  Rows rows;
  const std::string path = read_number_lines(
      options.text("File Name"), options.where("File Name"), [&](const NumberLine& line) {
        if (line.numbers.size() == columns) {
          rows.add(line.where, line.numbers);
        } else {
          rows.refuse(line.where, "8 numbers with commas between", line.text);
        }
      });
  return rows.take(path);
}

// Numbers between blanks; none if there is anything else.
std::vector<double> numbers_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<double> numbers;
  for (std::string word; stream >> word;) {
    const char* first = word.data() + (word.front() == '+' ? 1 : 0);
    const char* last = word.data() + word.size();
    double value = 0.0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) return {};
    numbers.push_back(value);
  }
  return numbers;
}

// What follows ! is a comment. A ninth column, the angle of an upward flow, must be zero.
std::vector<Row> read_openfast(const Options& options) {
  const Where& where = options.where("File Name");
  const std::string path =
      (std::filesystem::path(where.file).parent_path() / options.text("File Name")).string();
  std::istringstream file(read_file(path, where));
  Rows rows;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string text(trim(std::string_view(line).substr(0, line.find('!'))));
    if (text.empty()) continue;
    const std::vector<double> numbers = numbers_of(text);
    const Where here{path, number, {}};
    if (numbers.size() == columns || (numbers.size() == columns + 1 && numbers.back() == 0.0)) {
      rows.add(here, numbers);
    } else {
      rows.refuse(here, "8 numbers, and none or 0 as the ninth, an upward angle", text);
    }
  }
  return rows.take(path);
}

}  // namespace

void register_table(FlowRegistry& registry) {
  add_wind(
      registry, "Table",
      Schema("Table", "Wind that varies in time, as OpenFAST's uniform wind files have it.")
          .add(density_field())
          .add(text("File Name",
                    "Lines 'time, speed, direction in degrees clockwise from above, vertical "
                    "speed, linear shear across, exponent of the power law, linear shear upwards, "
                    "speed added everywhere'; linear in between, held outside. Of equal times the "
                    "later line holds from then on."))
          .add(choice(
                   "File Format", {"CSV", "OpenFAST"},
                   "Numbers with commas, or a uniform wind file of OpenFAST: numbers with blanks, "
                   "comments behind !.")
                   .optional("CSV"))
          .add(
              number("Height", "m", "Height above the origin at which the speeds hold.").positive())
          .add(number("Length", "m",
                      "Length over which the linear shears count, such as the "
                      "diameter of the rotor.")
                   .positive())
          .add_all(wind_axes_schema()),
      [](const Options& options, model::BuildContext& context) -> SharedFlow {
        std::vector<Row> rows =
            options.text("File Format") == "CSV" ? read_csv(options) : read_openfast(options);
        add_functions(options.name(), rows, context.model);
        return std::make_shared<Table>(options, std::move(rows));
      });
}

}  // namespace culm::flow
