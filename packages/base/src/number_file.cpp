#include <culm/base/number_file.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace culm {
namespace {

std::optional<double> find_number(std::string_view text) {
  text = trim(text);
  double value = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return {};
  return value;
}

std::vector<double> find_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const auto comma = text.find(',');
    const auto number = find_number(text.substr(0, comma));
    if (!number) return {};
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

std::string read_number_lines(const std::string& name, const Where& where,
                              const std::function<void(const NumberLine&)>& take) {
  std::string path = (std::filesystem::path(where.file).parent_path() / name).string();
  std::string whole = read_file(path, where);
  // spreadsheets begin with this mark of UTF-8
  if (whole.starts_with("\xEF\xBB\xBF")) whole.erase(0, 3);
  std::istringstream file(std::move(whole));
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string_view text = trim(std::string_view(line).substr(0, line.find('#')));
    if (!text.empty()) take({find_numbers(text), std::string(text), {path, number, {}}});
  }
  return path;
}

}  // namespace culm
