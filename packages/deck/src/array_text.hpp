#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culm::deck {

/// The items of "{a, b, c}", without the blanks around them. Commas inside parentheses and quotes
/// belong to an item; quotes ("…", with "" for a quote inside) are taken off. Empty if the text is
/// no array.
std::optional<std::vector<std::string>> split_array(std::string_view text);

/// The text of an array of texts, with quotes where split_array needs them.
std::string join_array(const std::vector<std::string>& items);

}  // namespace culm::deck
