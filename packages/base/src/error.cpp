#include <culm/base/error.hpp>

namespace culm {
namespace {

std::string lines(const std::vector<InputIssue>& issues) {
  std::string text;
  for (const InputIssue& issue : issues) {
    if (!text.empty()) text += '\n';
    text += to_string(issue);
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
