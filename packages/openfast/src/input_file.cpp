#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/input_file.hpp>

#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

namespace culm::openfast {

namespace {

// Capitals and brackets do not distinguish keywords.
std::string key_of(const std::string& keyword) {
  std::string key = to_lower(keyword);
  std::erase_if(key, [](char c) { return c == '(' || c == ')'; });
  return key;
}

// Rows of tables end with such words, too.
bool is_value(const std::string& word) {
  const std::string text = to_lower(word);
  return text == "true" || text == "false" || text == "default";
}

// Whether a keyword at this place ends an entry: a comment follows, or nothing. In the latter case
// the value must look like one, because headers of tables are words, too.
bool ends_entry(const std::vector<Word>& words, std::size_t at) {
  if (at + 1 < words.size()) {
    const char next = words[at + 1].text.empty() ? ' ' : words[at + 1].text.front();
    return next == '-' || next == '(' || next == '!';
  }
  const std::string& value = words.front().text;
  return words.front().quoted || find_number(value) || is_value(value);
}

std::vector<std::string> read_lines_of(const std::filesystem::path& path) {
  std::istringstream stream(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  lines_ = read_lines_of(path_);
  if (lines_.size() > 1) title_ = std::string(trim(lines_[1]));
  read_lines();
}

void InputFile::read_lines() {
  bool in_list = false;  // of output channels, which ends with END
  for (std::size_t i = 2; i < lines_.size(); ++i) {
    if (is_heading(lines_[i])) continue;
    const std::vector<Word> words = split_words(lines_[i]);
    if (words.empty()) continue;
    const std::string first = to_lower(words.front().text);
    if (in_list) {
      in_list = !first.starts_with("end");
      continue;
    }
    if (first == "outlist") {
      in_list = true;
      continue;
    }
    Entry entry{static_cast<int>(i) + 1, {}, {}, {words.front().text}};
    std::size_t at = 1;
    while (at < words.size() && (words[at].quoted || find_number(words[at].text))) {
      entry.values.push_back(words[at++].text);
    }
    if (at == words.size() || !is_keyword(words[at]) || is_value(words[at].text) ||
        !ends_entry(words, at))
      continue;
    entry.keyword = words[at].text;
    entry.key = key_of(entry.keyword);
    entries_.push_back(std::move(entry));
  }
}

const InputFile::Entry* InputFile::find(const std::string& keyword) const {
  const std::string key = key_of(keyword);
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

const InputFile::Entry& InputFile::get(const std::string& keyword) {
  const Entry* entry = find(keyword);
  if (entry == nullptr) throw InputError(where(keyword), "is missing");
  known_.insert(entry->key);
  return *entry;
}

Where InputFile::where(const std::string& keyword) const {
  const Entry* entry = find(keyword);
  return where(entry != nullptr ? entry->line : 0, keyword);
}

Where InputFile::where(int line, std::string name) const {
  return {path_.string(), line, std::move(name)};
}

double InputFile::number(const std::string& keyword) {
  const Entry& entry = get(keyword);
  const auto value = find_number(entry.values.front());
  if (!value) {
    throw InputError(where(keyword), "must be a number, got '" + entry.values.front() + "'");
  }
  if (entry.values.size() > 1) {
    throw InputError(where(keyword), "must be one number, got '" + join(entry.values, " ") + "'");
  }
  return *value;
}

double InputFile::number(const std::string& keyword, double otherwise) {
  return has(keyword) ? number(keyword) : otherwise;
}

int InputFile::integer(const std::string& keyword) {
  const double value = number(keyword);
  constexpr double largest = 1e6;
  if (value != std::floor(value) || std::abs(value) > largest) {
    throw InputError(where(keyword),
                     "must be a whole number, got '" + find(keyword)->values.front() + "'");
  }
  return static_cast<int>(value);
}

bool InputFile::flag(const std::string& keyword) {
  const std::string value = to_lower(get(keyword).values.front());
  if (value == "true" || value == "t" || value == ".true.") return true;
  if (value == "false" || value == "f" || value == ".false.") return false;
  throw InputError(where(keyword),
                   "must be True or False, got '" + find(keyword)->values.front() + "'");
}

std::string InputFile::text(const std::string& keyword) { return get(keyword).values.front(); }

std::vector<double> InputFile::numbers(const std::string& keyword) {
  std::vector<double> numbers;
  for (const std::string& value : get(keyword).values) {
    const auto number = find_number(value);
    if (!number) throw InputError(where(keyword), "must be numbers, got '" + value + "'");
    numbers.push_back(*number);
  }
  return numbers;
}

std::filesystem::path InputFile::file(const std::string& keyword) { return beside(text(keyword)); }

std::filesystem::path InputFile::beside(std::string name) const {
  std::replace(name.begin(), name.end(), '\\', '/');
  return (path_.parent_path() / name).lexically_normal();
}

std::vector<std::filesystem::path> InputFile::files(const std::string& keyword, int count) {
  const auto first = static_cast<std::size_t>(get(keyword).line) - 1;
  std::vector<std::filesystem::path> found;
  for (std::size_t i = first; found.size() < static_cast<std::size_t>(count); ++i) {
    const std::vector<Word> words =
        i < lines_.size() ? split_words(lines_[i]) : std::vector<Word>{};
    if (words.empty() || !words.front().quoted) {
      throw InputError(
          where(static_cast<int>(i) + 1, keyword),
          fmt::format("must be {} lines with a name in quotes, found {}", count, found.size()));
    }
    found.push_back(beside(words.front().text));
  }
  return found;
}

// Rows of one table: headers first, then lines of numbers up to the first line of another kind.
std::vector<NumberRow> InputFile::numbers_from(std::size_t line, int count, int columns) const {
  std::vector<NumberRow> rows;
  for (std::size_t i = line; i < lines_.size() && static_cast<int>(rows.size()) < count; ++i) {
    NumberRow row{static_cast<int>(i) + 1, leading_numbers(lines_[i])};
    const bool fits = static_cast<int>(row.values.size()) >= columns;
    if (fits) {
      rows.push_back(std::move(row));
    } else if (!rows.empty() && !trim(lines_[i]).empty()) {
      break;
    }
  }
  return rows;
}

std::vector<NumberRow> InputFile::table(const std::string& keyword, int count, int columns,
                                        const std::string& what) {
  const Entry& entry = get(keyword);
  auto rows = numbers_from(static_cast<std::size_t>(entry.line), count + 1, columns);
  if (static_cast<int>(rows.size()) < count) {
    const int line = rows.empty() ? entry.line : rows.back().line + 1;
    throw InputError(where(line, what), fmt::format("{} must be {} lines of {} numbers, found {}",
                                                    what, count, columns, rows.size()));
  }
  if (static_cast<int>(rows.size()) > count) {
    throw InputError(
        where(rows.back().line, what),
        fmt::format("more lines of numbers than the {} that {} announces", count, entry.keyword));
  }
  return rows;
}

std::size_t InputFile::find_heading(const std::string& heading) const {
  const std::string wanted = to_lower(heading);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (is_heading(lines_[i]) && to_lower(lines_[i]).find(wanted) != std::string::npos) return i;
  }
  return lines_.size();
}

std::vector<NumberRow> InputFile::numbers_below(const std::string& heading) const {
  std::vector<NumberRow> rows;
  for (std::size_t i = find_heading(heading) + 1; i < lines_.size(); ++i) {
    if (is_heading(lines_[i])) break;
    NumberRow row{static_cast<int>(i) + 1, leading_numbers(lines_[i])};
    if (!row.values.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<TextRow> InputFile::rows_from(std::size_t line) const {
  std::vector<TextRow> rows;
  for (std::size_t i = line; i < lines_.size() && !is_heading(lines_[i]); ++i) {
    TextRow row{static_cast<int>(i) + 1, {}};
    for (const Word& word : split_words(lines_[i])) {
      if (!word.quoted && (word.text.front() == '!' || word.text.front() == '#')) break;
      row.words.push_back(word.text);
    }
    if (!row.words.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<TextRow> InputFile::rows_after(const std::string& keyword) {
  return rows_from(static_cast<std::size_t>(get(keyword).line));
}

std::vector<TextRow> InputFile::rows_below(const std::string& heading) const {
  return rows_from(find_heading(heading) + 1);
}

bool InputFile::has_line(const std::string& word) const {
  const std::string wanted = to_lower(word);
  return std::any_of(lines_.begin(), lines_.end(), [&](const std::string& line) {
    return to_lower(trim(line)).starts_with(wanted);
  });
}

bool InputFile::has_heading(const std::string& heading) const {
  return find_heading(heading) < lines_.size();
}

std::vector<std::string> InputFile::columns_below(const std::string& heading) const {
  return columns_of(find_heading(heading) + 1);
}

std::vector<std::string> InputFile::columns_after(const std::string& keyword) const {
  const Entry* entry = find(keyword);
  return columns_of(entry != nullptr ? static_cast<std::size_t>(entry->line) : lines_.size());
}

std::vector<std::string> InputFile::columns_of(std::size_t line) const {
  std::vector<std::string> names;
  if (line >= lines_.size()) return names;
  for (const Word& word : split_words(lines_[line])) names.push_back(word.text);
  return names;
}

InputFile InputFile::part(const std::string& heading) const {
  std::size_t begin = heading.empty() ? 2 : find_heading(heading) + 1;
  if (begin > lines_.size()) {
    throw InputError(where(0, heading), "there is no heading with these words");
  }
  if (heading.empty() && begin < lines_.size() && is_heading(lines_[begin])) ++begin;
  std::size_t end = begin;
  while (end < lines_.size() && !is_heading(lines_[end])) ++end;
  InputFile one = *this;
  std::erase_if(one.entries_, [&](const Entry& entry) {
    const auto line = static_cast<std::size_t>(entry.line) - 1;
    return line < begin || line >= end;
  });
  return one;
}

void InputFile::ignore(const std::vector<std::string>& keywords) {
  for (const std::string& keyword : keywords) known_.insert(key_of(keyword));
}

std::vector<InputIssue> InputFile::unread() const {
  std::vector<InputIssue> issues;
  std::map<std::string, const Entry*> first;
  for (const Entry& entry : entries_) {
    const auto [before, fresh] = first.emplace(entry.key, &entry);
    if (!fresh && before->second->values != entry.values) {
      issues.push_back({where(entry.line, entry.keyword),
                        fmt::format("contradicts line {}, which was taken", before->second->line)});
    } else if (fresh && !known_.contains(entry.key)) {
      issues.push_back({where(entry.line, entry.keyword),
                        fmt::format("unknown entry, left out: '{}'", entry.values.front())});
    }
  }
  return issues;
}

}  // namespace culm::openfast
