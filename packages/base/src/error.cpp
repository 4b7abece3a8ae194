#include <culm/base/error.hpp>

#include <algorithm>

namespace culm {
namespace {

std::string lines(const std::vector<InputIssue>& issues) {
  constexpr std::size_t shown = 100;
  std::string text;
  for (std::size_t i = 0; i < std::min(issues.size(), shown); ++i) {
    if (i > 0) text += '\n';
    text += to_string(issues[i]);
  }
  if (issues.size() > shown) {
    text += "\nand " + std::to_string(issues.size() - shown) + " more mistakes";
  }
  return text;
}

/// The part of a path that is the same on every machine.
std::string_view path_in_project(std::string_view path) {
  for (const std::string_view folder : {"packages/", "src/", "tests/"}) {
    const auto begin = path.rfind(folder);
    if (begin != std::string_view::npos) return path.substr(begin);
  }
  return path;
}

std::string bug_report(std::string_view text, std::string_view file, int line) {
  return std::string(path_in_project(file)) + ":" + std::to_string(line) + ": " +
         std::string(text) + " – this is a bug in culm, please report it";
}

}  // namespace

InternalError::InternalError(std::string_view text, const char* file, int line)
    : Error(bug_report(text, file, line)) {}

InputError::InputError(std::vector<InputIssue> issues)
    : Error(lines(issues)), issues_(std::move(issues)) {}

InputError::InputError(Where where, std::string message)
    : InputError(std::vector{InputIssue{std::move(where), std::move(message)}}) {}

}  // namespace culm
