/// Words of a line as Fortran's list-directed input separates them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culm::openfast {

/// A word and whether it stood in quotes.
struct Word {
  std::string text;
  bool quoted = false;
};

/// Words between blanks and commas; a text in quotes, double or single, is one word without them.
std::vector<Word> split_words(std::string_view line);

/// The number, if the whole word is one; exponents may be written with E or D.
std::optional<double> find_number(const std::string& word);

/// The numbers with which a line begins.
std::vector<double> leading_numbers(std::string_view line);

/// Whether a word can be a keyword: a letter, then letters, digits, underscores and brackets.
bool is_keyword(const Word& word);

/// Whether a line separates sections: it begins with dashes or equal signs.
bool is_heading(std::string_view line);

}  // namespace culm::openfast
