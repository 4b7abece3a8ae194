#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace culm {

/// The shortest text that reads back as exactly this number.
std::string format_number(double value);

/// The items with `separator` between them.
std::string join(const std::vector<std::string>& items, std::string_view separator);

/// The text without white space at both ends.
std::string_view trim(std::string_view text);

/// The text, or its beginning with a note of how much is left out if it has more than `most` bytes.
/// A character of UTF-8 is not cut in two.
std::string shortened(std::string_view text, std::size_t most);

/// The text in lower case; ASCII letters only.
std::string to_lower(std::string_view text);

}  // namespace culm
