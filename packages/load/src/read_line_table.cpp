#include "read_line_table.hpp"

#include <culm/base/number_file.hpp>
#include <culm/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace culm::load {
namespace {

// Bent elements, and files of a few digits, leave that much of a length.
constexpr double length_slip = 1e-3;

void check_given(const Options& options, InputIssues& issues) {
  const bool has_values = options.has("Forces") || options.has("Moments");
  if (options.has("Positions") == options.has("File Name")) {
    issues.add(options.where(), "give one of 'Positions' and 'File Name'");
  } else if (options.has("File Name") && has_values) {
    issues.add(options.where(options.has("Forces") ? "Forces" : "Moments"),
               "the values stand in the file of 'File Name'");
  } else if (options.has("Positions") && !has_values) {
    issues.add(options.where(), "'Positions' needs 'Forces' or 'Moments', or both");
  }
}

void check_sizes(const Options& options, InputIssues& issues) {
  if (!options.has("Positions")) return;
  const std::size_t count = options.numbers("Positions").size();
  for (const char* values : {"Forces", "Moments"}) {
    if (!options.has(values) || options.numbers(values).size() == 3 * count) continue;
    issues.add(options.where(values),
               fmt::format("must have three components for each of {} positions, {} numbers, got "
                           "{}",
                           count, 3 * count, options.numbers(values).size()));
  }
}

// The rows of a table as they stand, before positions become metres.
class Rows {
 public:
  Rows(const Options& options, double length)
      : in_metres_(options.text("Position Measure") == "Metres"), length_(length) {}

  /// Says what is wrong with the position, if nothing was before: a wrong measure makes all wrong.
  void add(double position, const Vec6& value, const Where& where, InputIssues& issues) {
    const std::string wrong = sound_ ? mistake(position) : "";
    if (!wrong.empty()) issues.add(where, wrong);
    sound_ = sound_ && wrong.empty();
    positions_.push_back(position);
    values_.push_back(value);
  }

  std::size_t size() const { return positions_.size(); }
  LineTable table() && {
    if (!in_metres_) {
      for (double& position : positions_) position *= length_;
    }
    return {std::move(positions_), std::move(values_)};
  }

 private:
  std::string mistake(double position) const {
    const double most = in_metres_ ? length_ * (1.0 + length_slip) : 1.0;
    if (!(position >= 0.0 && position <= most)) {
      return in_metres_ ? fmt::format(
                              "positions must lie between 0 and the length of the line, "
                              "{:.6g} m, got {:g} m",
                              length_, position)
                        : fmt::format(
                              "positions must lie between 0 and 1, as fractions of the "
                              "length of the line, got {:g}; 'Position Measure' Metres "
                              "takes lengths",
                              position);
    }
    if (positions_.empty() || position >= positions_.back()) return {};
    return fmt::format("positions must not descend, got {:g} after {:g}", position,
                       positions_.back());
  }

  bool in_metres_;
  double length_;
  bool sound_ = true;
  std::vector<double> positions_;
  std::vector<Vec6> values_;
};

void read_lists(const Options& options, Rows& rows, InputIssues& issues) {
  const auto part = [&](const char* name, std::size_t i) -> Vec3 {
    if (!options.has(name)) return Vec3::Zero();
    return Vec3(options.numbers(name).data() + 3 * i);
  };
  const std::vector<double>& positions = options.numbers("Positions");
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Vec6 value;
    value << part("Forces", i), part("Moments", i);
    rows.add(positions[i], value, options.where("Positions"), issues);
  }
}

void read_lines(const Options& options, Rows& rows, InputIssues& issues) {
  const Where& where = options.where("File Name");
  const std::string path =
      read_number_lines(options.text("File Name"), where, [&](const NumberLine& line) {
        if (line.numbers.size() != 4 && line.numbers.size() != 7) {
          issues.add(line.where,
                     "must be 'position, Fx, Fy, Fz' or 'position, Fx, Fy, Fz, Mx, My, "
                     "Mz', got '" +
                         shortened(line.text, 60) + "'");
          return;
        }
        Vec6 value = Vec6::Zero();
        std::copy(line.numbers.begin() + 1, line.numbers.end(), value.begin());
        rows.add(line.numbers.front(), value, line.where, issues);
      });
  if (rows.size() < 2) {
    issues.add({path, 0, {}}, fmt::format("must have at least two positions, got {}", rows.size()));
  }
}

}  // namespace

Schema line_table_fields() {
  return Schema("")
      .add(
          numbers("Positions", "",
                  "Places of the values along the line, not descending. The load is linear between "
                  "them, jumps where two are equal, and is zero before the first and beyond the "
                  "last.")
              .min_size(2)
              .non_negative()
              .optional())
      .add(
          choice("Position Measure", {"Fraction", "Metres"},
                 "Fraction: of the length of the line, from 0 to 1. Metres: length from its start. "
                 "Of an element set the elements count in its order.")
              .optional("Fraction"))
      .add(numbers("Forces", "N/m",
                   "Forces per reference length, three components for each position, at function "
                   "value 1.")
               .size_multiple_of(3)
               .optional())
      .add(numbers("Moments", "N m/m", "Moments per reference length, likewise.")
               .size_multiple_of(3)
               .optional())
      .add(
          text("File Name",
               "Instead of the three: a comma-separated file, relative to the deck, with position, "
               "Fx, Fy, Fz, or these and Mx, My, Mz, in a line; # starts a comment.")
              .optional())
      .check(check_given)
      .check(check_sizes);
}

std::string source_of(const char* values, const Options& options) {
  return options.has("File Name") ? "File Name" : values;
}

std::optional<LineTable> read_line_table(const Options& options, double length,
                                         InputIssues& issues) {
  const std::size_t before = issues.size();
  Rows rows(options, length);
  if (options.has("File Name")) {
    read_lines(options, rows, issues);
  } else {
    read_lists(options, rows, issues);
  }
  if (issues.size() != before) return {};
  return std::move(rows).table();
}

}  // namespace culm::load
