#include <culm/base/error.hpp>
#include <culm/base/issue.hpp>

#include <algorithm>

namespace culm {

std::string to_string(const Where& where) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.path.empty()) return text;
  return text.empty() ? where.path : text + ": " + where.path;
}

std::string join_path(const std::string& parent, const std::string& name) {
  return parent.empty() ? name : parent + " / " + name;
}

std::string to_string(const InputIssue& issue) {
  const std::string place = to_string(issue.where);
  return place.empty() ? issue.message : place + ": " + issue.message;
}

void InputIssues::add(Where where, std::string message) {
  add(InputIssue{std::move(where), std::move(message)});
}

void InputIssues::add(InputIssue issue) { issues_.push_back(std::move(issue)); }

std::vector<InputIssue> InputIssues::sorted() const {
  std::vector<std::string> files;
  for (const InputIssue& issue : issues_) {
    if (std::ranges::find(files, issue.where.file) == files.end()) {
      files.push_back(issue.where.file);
    }
  }
  const auto order = [&](const InputIssue& issue) {
    return std::pair(std::ranges::find(files, issue.where.file), issue.where.line);
  };
  std::vector<InputIssue> sorted = issues_;
  std::ranges::stable_sort(sorted, {}, order);
  return sorted;
}

void InputIssues::throw_if_any() const {
  if (!empty()) throw InputError(sorted());
}

}  // namespace culm
