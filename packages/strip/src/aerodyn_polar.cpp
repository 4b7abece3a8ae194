#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>

#include "polar_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <sstream>

namespace culm::strip {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::optional<double> number_of(const std::string& word) {
  double value = 0.0;
  const char* last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return {};
  return value;
}

std::optional<PolarRow> row_of(const std::vector<std::string>& words) {
  if (words.size() < 3) return {};
  double values[4] = {};
  for (std::size_t i = 0; i < std::min<std::size_t>(words.size(), 4); ++i) {
    const auto value = number_of(words[i]);
    if (!value) return {};
    values[i] = *value;
  }
  return PolarRow{values[0] * std::numbers::pi / 180.0, {values[1], values[2], values[3]}};
}

}  // namespace

// Lines 'value name comment' in any order, comments with !, and after NumAlf as many rows.
std::vector<PolarRow> read_aerodyn_polar(const std::string& name, const Where& where,
                                         std::string& path) {
  path = (std::filesystem::path(where.file).parent_path() / name).string();
  std::istringstream file(read_file(path, where));
  std::vector<PolarRow> rows;
  std::size_t expected = 0;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (expected > 0 && rows.size() == expected) break;
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words[0].front() == '!') continue;
    const Where here{path, number, {}};
    if (expected > 0) {
      const auto row = row_of(words);
      if (!row) {
        throw InputError(here, "must be 'angle in degrees, lift, drag, moment', got '" +
                                   shortened(line, 60) + "'");
      }
      rows.push_back(*row);
      continue;
    }
    if (words.size() < 2) continue;
    const auto value = number_of(words[0]);
    if (words[1] == "NumTabs" && value != 1.0) {
      throw InputError(here,
                       "must be 1: polars that depend on the Reynolds number are not known, "
                       "got '" +
                           words[0] + "'");
    }
    if (words[1] != "NumAlf") continue;
    if (!value || *value < 1.0 || *value > 1e6 || *value != std::floor(*value)) {
      throw InputError(here, "NumAlf must be a number of rows, got '" + words[0] + "'");
    }
    expected = static_cast<std::size_t>(*value);
  }
  if (expected == 0) throw InputError({path, 0, {}}, "has no line 'NumAlf'");
  if (rows.size() != expected) {
    throw InputError({path, number, {}},
                     fmt::format("ends after {} of {} rows", rows.size(), expected));
  }
  return rows;
}

}  // namespace culm::strip
