#pragma once

// This header stays C++17: the sources that need Teuchos validators read it as such.

#include <cstddef>
#include <string>
#include <vector>

namespace culm {

/// A place in the input: the file, its line (from 1; 0 when there is none, as on the command line)
/// and the path of names that leads to it, such as "Structures / beam / Section".
struct Where {
  std::string file;
  int line = 0;
  std::string path;
};

/// "file:line: path", without the parts that are empty.
std::string to_string(const Where& where);

/// Path of a name below `parent`: "parent / name", or the name alone when the parent is empty.
std::string join_path(const std::string& parent, const std::string& name);

/// One mistake of the input: the place, and a message with the rule and the value found.
struct InputIssue {
  Where where;
  std::string message;
};

/// "file:line: path: message"
std::string to_string(const InputIssue& issue);

/// Collects all mistakes of one pass over the input, so that a user can repair them in one go.
class InputIssues {
 public:
  void add(Where where, std::string message);
  void add(InputIssue issue);
  bool empty() const { return issues_.empty(); }
  std::size_t size() const { return issues_.size(); }

  /// The issues by file (in the order in which the files first appear), then by line.
  std::vector<InputIssue> sorted() const;

  /// Throws InputError with all issues, sorted, if there is any.
  void throw_if_any() const;

 private:
  std::vector<InputIssue> issues_;
};

}  // namespace culm
