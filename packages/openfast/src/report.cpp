#include <culm/openfast/report.hpp>

#include <algorithm>

namespace culm::openfast {

void Report::add(const std::string& heading, const std::string& line) {
  const auto found = std::find_if(parts_.begin(), parts_.end(),
                                  [&](const Part& part) { return part.heading == heading; });
  if (found == parts_.end()) {
    parts_.push_back({heading, {line}});
  } else {
    found->lines.push_back(line);
  }
}

void Report::add(const std::string& heading, const std::vector<InputIssue>& issues) {
  for (const InputIssue& issue : issues) add(heading, to_string(issue));
}

std::string Report::text(const std::string& title) const {
  std::string text = title + "\n";
  for (const Part& part : parts_) {
    text += "\n" + part.heading + "\n";
    for (const std::string& line : part.lines) text += "  " + line + "\n";
  }
  return text;
}

}  // namespace culm::openfast
