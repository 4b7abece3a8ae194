#include "words.hpp"

#include <culm/base/text.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace culm::openfast {

namespace {

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; }

}  // namespace

std::vector<Word> split_words(std::string_view line) {
  std::vector<Word> words;
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && is_separator(line[at])) ++at;
    if (at == line.size()) return words;
    const char first = line[at];
    if (first == '"' || first == '\'') {
      const std::size_t end = std::min(line.find(first, at + 1), line.size());
      words.push_back({std::string(line.substr(at + 1, end - at - 1)), true});
      at = std::min(end + 1, line.size());
    } else {
      std::size_t end = at;
      while (end < line.size() && !is_separator(line[end])) ++end;
      words.push_back({std::string(line.substr(at, end - at)), false});
      at = end;
    }
  }
}

std::optional<double> find_number(const std::string& word) {
  std::string text = word;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return {};
  return value;
}

std::vector<double> leading_numbers(std::string_view line) {
  std::vector<double> numbers;
  for (const Word& word : split_words(line)) {
    const auto number = word.quoted ? std::nullopt : find_number(word.text);
    if (!number) break;
    numbers.push_back(*number);
  }
  return numbers;
}

bool is_keyword(const Word& word) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '(' || c == ')';
  };
  return !word.quoted && std::isalpha(static_cast<unsigned char>(word.text.front())) != 0 &&
         std::all_of(word.text.begin(), word.text.end(), allowed);
}

bool is_heading(std::string_view line) {
  const std::string_view text = trim(line);
  return text.starts_with("--") || text.starts_with("==");
}

}  // namespace culm::openfast
