#pragma once

#include <culm/base/issue.hpp>
#include <culm/base/read_file.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace culm::deck {

/// Stands for the file of whatever comes from the command line.
inline constexpr const char* command_line = "command line";

/// A <Parameter> or <Variable> as written.
struct RawParameter {
  std::string file;
  int line = 0;
  std::string name;
  std::optional<std::string> value;  ///< missing by mistake
  std::optional<std::string> type;
  std::optional<std::string> unit;
  bool is_default = false;   ///< marked as such by a resolved deck
  bool is_reported = false;  ///< why there is no value is among the issues already
};

/// A <ParameterList> as written, with its includes in place.
struct RawList {
  std::string file;
  int line = 0;
  std::string name;
  std::vector<RawParameter> parameters;
  std::vector<RawParameter> variables;
  std::vector<RawList> lists;
  /// A mistake that is among the issues already may be why something is missing here.
  bool is_incomplete = false;
};

/// Gives what is in a file.
using TextSource = std::function<FileText(const std::string& path)>;

/// Reads a deck and what it includes. Throws InputError if the first file is not well-formed; all
/// other mistakes of form are added to `issues`.
RawList read_raw(const std::string& text, const std::string& file, const TextSource& includes,
                 InputIssues& issues);

/// Applies assignments from the command line. Throws UsageError if one is no assignment, InputError
/// if it takes a parameter for a list.
void apply_overrides(const std::vector<std::string>& overrides, RawList& root);

}  // namespace culm::deck
