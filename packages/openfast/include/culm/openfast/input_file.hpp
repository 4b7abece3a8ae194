/// Text files as the modules of OpenFAST read them.
#pragma once

#include <culm/base/issue.hpp>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace culm::openfast {

/// A line of a file, counted from 1, and its numbers.
struct NumberRow {
  int line = 0;
  std::vector<double> values;
};

/// A line of a file, counted from 1, and its words up to a comment, which begins with ! or #.
struct TextRow {
  int line = 0;
  std::vector<std::string> words;
};

/// A file whose lines hold a value, its keyword and a comment, `49  kp_total - Total number …`,
/// with tables in between. Values are found by their keywords, whatever their order, so that
/// formats of several years can be read; capitals do not matter, and `BldFile1` is `BldFile(1)`.
///
/// What has been asked for is remembered: unread() names the rest.
class InputFile {
 public:
  /// Throws FileError.
  explicit InputFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// The second line, which describes the content.
  const std::string& title() const { return title_; }

  bool has(const std::string& keyword) const { return find(keyword) != nullptr; }
  /// Where an entry stands; line 0 if there is none.
  Where where(const std::string& keyword) const;
  /// A place in this file.
  Where where(int line, std::string name) const;

  // These throw InputError if the entry is missing or has another form.
  double number(const std::string& keyword);
  int integer(const std::string& keyword);
  bool flag(const std::string& keyword);
  std::string text(const std::string& keyword);
  /// All values before the keyword.
  std::vector<double> numbers(const std::string& keyword);
  /// The same, or `otherwise` where there is no such entry.
  double number(const std::string& keyword, double otherwise);
  /// The path of a file that is named in this one, from whose folder names count.
  std::filesystem::path beside(std::string name) const;
  /// A file that the entry names, relative to this one.
  std::filesystem::path file(const std::string& keyword);
  /// As many files, the first in the line of the entry and each other one in the next line. Throws
  /// InputError where a line does not begin with a name in quotes.
  std::vector<std::filesystem::path> files(const std::string& keyword, int count);

  /// The next `count` lines below the entry that hold at least `columns` numbers; headers before
  /// the first of them are skipped. Throws InputError naming `what` where there are fewer, or more.
  std::vector<NumberRow> table(const std::string& keyword, int count, int columns,
                               const std::string& what);
  /// Lines of numbers below the first heading that contains `heading` (capitals do not matter); of
  /// any lengths, up to the next heading or the end. Empty if there is no such heading.
  std::vector<NumberRow> numbers_below(const std::string& heading) const;
  /// Words of the lines below an entry, or below the first heading that contains a text, up to the
  /// next heading or the end; without empty lines. Empty if there is no such heading.
  std::vector<TextRow> rows_after(const std::string& keyword);
  std::vector<TextRow> rows_below(const std::string& heading) const;
  bool has_heading(const std::string& heading) const;
  /// Whether a line begins with a word; capitals do not matter.
  bool has_line(const std::string& word) const;
  /// Names of the columns of a table: the words of the first line below a heading, or an entry.
  std::vector<std::string> columns_below(const std::string& heading) const;
  std::vector<std::string> columns_after(const std::string& keyword) const;
  /// The entries below the first heading that contains `heading`, up to the next one, as a file of
  /// their own; those above the first heading with an empty one. Throws InputError where there is
  /// no such heading.
  InputFile part(const std::string& heading) const;

  /// Says that these entries are known and not used.
  void ignore(const std::vector<std::string>& keywords);
  /// Entries that nobody asked for or ignored, and second values of one keyword, with their places.
  std::vector<InputIssue> unread() const;

 private:
  struct Entry {
    int line;
    std::string keyword;  // as it stands
    std::string key;      // for comparison
    std::vector<std::string> values;
  };

  void read_lines();
  const Entry* find(const std::string& keyword) const;
  const Entry& get(const std::string& keyword);
  std::size_t find_heading(const std::string& heading) const;
  std::vector<TextRow> rows_from(std::size_t line) const;
  std::vector<std::string> columns_of(std::size_t line) const;
  std::vector<NumberRow> numbers_from(std::size_t line, int count, int columns) const;

  std::filesystem::path path_;
  std::string title_;
  std::vector<std::string> lines_;
  std::vector<Entry> entries_;
  std::set<std::string> known_;
};

}  // namespace culm::openfast
