/// Points of a function of time.
#pragma once

#include <culm/base/issue.hpp>

#include <string>
#include <vector>

namespace culm::model {

/// Linear between its points, constant outside.
struct TimeTable {
  std::vector<double> times;  ///< increasing [s]
  std::vector<double> values;

  double value(double time) const;
  /// What is wrong with such a table; empty if nothing is.
  static std::string mistake(const std::vector<double>& times, const std::vector<double>& values);
};

/// Reads "time, value" lines; empty lines and what follows # are skipped.
/// Throws FileError if the file cannot be read, InputError with file and line if it is no table.
/// @param name   relative to the folder of the deck, or absolute
/// @param where  the place of the name in the deck
TimeTable read_time_table(const std::string& name, const Where& where);

}  // namespace culm::model
