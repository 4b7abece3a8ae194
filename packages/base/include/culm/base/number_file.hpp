/// Tables of numbers in comma-separated files.
#pragma once

#include <culm/base/issue.hpp>

#include <functional>
#include <string>
#include <vector>

namespace culm {

/// A line that is neither empty nor a comment.
struct NumberLine {
  std::vector<double> numbers;  ///< finite ones; none if the line holds anything else
  std::string text;             ///< without comment, for messages
  Where where;
};

/// Reads lines of numbers with commas between them; what follows # is a comment.
/// Throws FileError if the file cannot be read.
/// @param name   relative to the folder of the deck, or absolute
/// @param where  the place of the name in the deck
/// @param take   called for each line in turn
/// @return path of the file
std::string read_number_lines(const std::string& name, const Where& where,
                              const std::function<void(const NumberLine&)>& take);

}  // namespace culm
