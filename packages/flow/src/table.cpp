// Winds that vary in time, by the columns and formulas of OpenFAST's uniform wind files.
#include <culm/base/error.hpp>
#include <culm/base/number_file.hpp>
#include <culm/base/text.hpp>

#include "reference_wind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace culm::flow {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

enum Column { at, speed, direction, vertical, across_shear, exponent, up_shear, gust, columns };
using Row = std::array<double, columns>;

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
    const Row now = row_at(time);
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

 private:
  // Linear between rows, held before the first and after the last; the later of equal times.
  Row row_at(double time) const {
    const auto after =
        std::upper_bound(rows_.begin(), rows_.end(), time,
                         [](double moment, const Row& row) { return moment < row[at]; });
    if (after == rows_.begin()) return rows_.front();
    if (after == rows_.end()) return rows_.back();
    const Row& low = *(after - 1);
    const double share = (time - low[at]) / ((*after)[at] - low[at]);
    Row row;
    for (std::size_t c = 0; c < columns; ++c) row[c] = low[c] + share * ((*after)[c] - low[c]);
    return row;
  }

  WindAxes axes_;
  double height_, length_;
  std::vector<Row> rows_;
};

std::vector<Row> read_rows(const Options& options) {
  std::vector<Row> rows;
  InputIssues issues;
  const std::string path = read_number_lines(
      options.text("File Name"), options.where("File Name"), [&](const NumberLine& line) {
        if (line.numbers.size() != columns) {
          issues.add(line.where, "must be 8 numbers with commas between, got '" +
                                     shortened(line.text, 60) + "'");
          return;
        }
        Row row;
        std::copy(line.numbers.begin(), line.numbers.end(), row.begin());
        row[direction] *= degree;
        if (!rows.empty() && row[at] < rows.back()[at])
          issues.add(line.where, fmt::format("times must not fall, got {:g} s after {:g} s",
                                             row[at], rows.back()[at]));
        rows.push_back(row);
      });
  issues.throw_if_any();
  if (rows.empty()) throw InputError({path, 0, {}}, "a table of wind needs at least one line");
  return rows;
}

}  // namespace

void register_table(FlowRegistry& registry) {
  registry.add(
      "Table",
      Schema("Table", "Wind that varies in time, as OpenFAST's uniform wind files have it.")
          .add(density_field())
          .add(text("File Name",
                    "Lines 'time, speed, direction in degrees clockwise from above, vertical "
                    "speed, linear shear across, exponent of the power law, linear shear upwards, "
                    "speed added everywhere'; linear in between, held outside. Of equal times the "
                    "later line holds from then on."))
          .add(
              number("Height", "m", "Height above the origin at which the speeds hold.").positive())
          .add(number("Length", "m",
                      "Length over which the linear shears count, such as the "
                      "diameter of the rotor.")
                   .positive())
          .add_all(wind_axes_schema()),
      [](const Options& options, model::BuildContext&) -> SharedFlow {
        return std::make_shared<Table>(options, read_rows(options));
      });
}

}  // namespace culm::flow
