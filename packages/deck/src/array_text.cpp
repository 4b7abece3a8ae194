#include "array_text.hpp"

#include <culm/base/text.hpp>

namespace culm::deck {
namespace {

/// "a ""b""" without its quotes; empty if the closing quote is missing or not the end.
std::optional<std::string> unquoted(std::string_view item) {
  std::string text;
  for (std::size_t i = 1; i < item.size(); ++i) {
    if (item[i] != '"') {
      text += item[i];
    } else if (i + 1 < item.size() && item[i + 1] == '"') {
      text += item[i++];
    } else {
      return i + 1 == item.size() ? std::optional(text) : std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<std::string>> split_array(std::string_view text) {
  text = trim(text);
  if (text.size() < 2 || text.front() != '{' || text.back() != '}') return std::nullopt;
  text = text.substr(1, text.size() - 2);
  std::vector<std::string> items;
  if (trim(text).empty()) return items;
  std::size_t begin = 0;
  int depth = 0;
  bool in_quotes = false;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const bool ends = i == text.size();
    if (!ends) {
      const char symbol = text[i];
      if (symbol == '"') in_quotes = !in_quotes;
      if (in_quotes) continue;
      if (symbol == '{' || symbol == '}') return std::nullopt;
      depth += symbol == '(' ? 1 : symbol == ')' ? -1 : 0;
      if (symbol != ',' || depth > 0) continue;
    }
    const std::string_view item = trim(text.substr(begin, i - begin));
    begin = i + 1;
    if (!item.starts_with('"')) {
      items.emplace_back(item);
    } else if (std::optional<std::string> content = unquoted(item)) {
      items.push_back(std::move(*content));
    } else {
      return std::nullopt;
    }
  }
  return items;
}

std::string join_array(const std::vector<std::string>& items) {
  std::vector<std::string> texts;
  for (const std::string& item : items) {
    const bool plain = !item.empty() && trim(item) == item &&
                       item.find_first_of(",{}()\"\n\t\r") == std::string::npos;
    if (plain) {
      texts.push_back(item);
      continue;
    }
    std::string quoted = "\"";
    for (const char symbol : item) quoted += symbol == '"' ? "\"\"" : std::string(1, symbol);
    texts.push_back(quoted + "\"");
  }
  return "{" + join(texts, ", ") + "}";
}

}  // namespace culm::deck
