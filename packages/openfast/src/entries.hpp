/// Entries of files that several readers ask for in the same way.
#pragma once

#include <culm/base/error.hpp>
#include <culm/openfast/input_file.hpp>
#include <culm/openfast/text_table.hpp>

#include <fmt/format.h>

#include <string>

namespace culm::openfast {

/// A number above zero; throws InputError.
inline double positive(InputFile& file, const std::string& keyword) {
  const double value = file.number(keyword);
  if (!(value > 0.0)) {
    throw InputError(file.where(keyword), fmt::format("must be positive, got {:g}", value));
  }
  return value;
}

/// A number that is not below zero; throws InputError.
inline double non_negative(InputFile& file, const std::string& keyword) {
  const double value = file.number(keyword);
  if (!(value >= 0.0)) {
    throw InputError(file.where(keyword), fmt::format("must not be negative, got {:g}", value));
  }
  return value;
}

/// The same in a table.
inline double positive(const TextTable& table, std::size_t row, TextTable::Names names) {
  const double value = table.number(row, names);
  if (value > 0.0) return value;
  throw InputError(table.where(row, names), fmt::format("must be > 0, got {:g}", value));
}

/// Keywords that are alike in several parts of a file have endings since some year.
inline const char* name_of(const InputFile& file, const char* now, const char* before) {
  return file.has(now) || !file.has(before) ? now : before;
}

}  // namespace culm::openfast
