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

std::string bug_report(std::string_view text, const std::source_location& place) {
  return std::string(place.file_name()) + ":" + std::to_string(place.line()) + ": " +
         std::string(text) + " – this is a bug in culm, please report it";
}

}  // namespace

InternalError::InternalError(std::string_view text, std::source_location place)
    : Error(bug_report(text, place)) {}

InputError::InputError(std::vector<InputIssue> issues)
    : Error(lines(issues)), issues_(std::move(issues)) {}

InputError::InputError(Where where, std::string message)
    : InputError(std::vector{InputIssue{std::move(where), std::move(message)}}) {}

}  // namespace culm
