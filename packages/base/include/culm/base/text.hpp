#pragma once

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

/// The text in lower case; ASCII letters only.
std::string to_lower(std::string_view text);

}  // namespace culm
