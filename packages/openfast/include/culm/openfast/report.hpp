/// What an import has to say beside the deck.
#pragma once

#include <culm/base/issue.hpp>

#include <string>
#include <vector>

namespace culm::openfast {

/// Sentences under headings, in the order in which the headings are first used.
class Report {
 public:
  /// Adds a line below a heading.
  void add(const std::string& heading, const std::string& line);
  /// Adds places with their messages below a heading.
  void add(const std::string& heading, const std::vector<InputIssue>& issues);

  /// The whole as text.
  std::string text(const std::string& title) const;

 private:
  struct Part {
    std::string heading;
    std::vector<std::string> lines;
  };
  std::vector<Part> parts_;
};

}  // namespace culm::openfast
