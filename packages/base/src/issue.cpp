#include <culm/base/error.hpp>
#include <culm/base/issue.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <unordered_map>
#include <utility>

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
  // names and values of the input may be of any length
  const Where where{issue.where.file, issue.where.line, shortened(issue.where.path, 300)};
  const std::string place = to_string(where);
  const std::string message = shortened(issue.message, 2000);
  return place.empty() ? message : place + ": " + message;
}

void InputIssues::add(Where where, std::string message) {
  add(InputIssue{std::move(where), std::move(message)});
}

void InputIssues::add(InputIssue issue) { issues_.push_back(std::move(issue)); }

std::vector<InputIssue> InputIssues::sorted() const {
  std::unordered_map<std::string, std::size_t> files;
  for (const InputIssue& issue : issues_) files.emplace(issue.where.file, files.size());
  const auto order = [&](const InputIssue& issue) {
    return std::pair(files.at(issue.where.file), issue.where.line);
  };
  std::vector<InputIssue> sorted = issues_;
  std::ranges::stable_sort(sorted, {}, order);
  return sorted;
}

void InputIssues::throw_if_any() const {
  if (!empty()) throw InputError(sorted());
}

}  // namespace culm
