// Files of airfoils for AeroDyn: lines 'value name ! comment', after each NumAlf a table.
#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/aerodyn.hpp>

#include "degree.hpp"
#include "headings.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace culm::openfast {

namespace {

// by which a table may miss its ends and itself at both of them: the digits of files
constexpr double closing_angle = 1e-3;
constexpr double closing_coefficient = 0.05;
constexpr double most_rows = 1e5;

// Constants of culm's lags and stall, by their names in the files.
constexpr std::pair<const char*, double> constants[] = {{"A1", 0.3},  {"A2", 0.7},  {"b1", 0.14},
                                                        {"b2", 0.53}, {"T_p", 1.7}, {"T_f0", 3.0}};

struct Line {
  int number = 0;
  std::vector<Word> words;
};

// Lines with words, without comments.
std::vector<Line> lines_of(const std::filesystem::path& path) {
  std::istringstream stream(read_file(path));
  std::vector<Line> lines;
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    std::vector<Word> words = split_words(text);
    const auto comment = std::find_if(words.begin(), words.end(), [](const Word& word) {
      return !word.quoted && word.text.front() == '!';
    });
    words.erase(comment, words.end());
    if (!words.empty()) lines.push_back({number, std::move(words)});
  }
  return lines;
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, const AirfoilColumns& columns, Report& report)
      : path_(path), columns_(columns), report_(report), lines_(lines_of(path)) {}

  std::vector<AirfoilRow> read() {
    for (at_ = 0; at_ < lines_.size(); ++at_) take(lines_[at_]);
    if (announced_ == 0) throw InputError({path_.string(), 0, "NumTabs"}, "is missing");
    if (found_ != announced_) {
      throw InputError(
          {path_.string(), 0, "NumAlf"},
          fmt::format("stands there {} times, NumTabs announces {} tables", found_, announced_));
    }
    check_ends();
    report_.add(openfast::read,
                fmt::format("{}: airfoil, {} angles", path_.string(), rows_.size()));
    if (announced_ > 1) {
      report_.add(
          not_used,
          fmt::format("{}: {} of {} tables, for Re = {} million: the first one, for {}, "
                      "counts everywhere",
                      path_.string(), announced_ - 1, announced_,
                      join({reynolds_.begin() + 1, reynolds_.end()}, ", "), reynolds_.front()));
    }
    if (!others_.empty()) {
      report_.add(not_used, fmt::format("{}: {}; lags and stall have constants of their own: {}",
                                        path_.string(), join(others_, ", "), own_constants()));
    }
    return rows_;
  }

 private:
  static std::string own_constants() {
    std::vector<std::string> all;
    for (const auto& [name, value] : constants)
      all.push_back(fmt::format("{} = {:g}", name, value));
    return join(all, ", ");
  }

  InputError mistake(const Line& line, const std::string& name, const std::string& text) const {
    return InputError({path_.string(), line.number, name}, text);
  }

  int count(const Line& line, const std::string& name) const {
    const auto value = find_number(line.words[0].text);
    if (!value || *value != std::floor(*value) || *value < 1.0 || *value > most_rows) {
      throw mistake(line, name,
                    "must be a whole number above zero, got '" + line.words[0].text + "'");
    }
    return static_cast<int>(*value);
  }

  void take(const Line& line) {
    if (line.words.size() < 2) return;
    const std::string key = to_lower(line.words[1].text);
    if (key == "numtabs") announced_ = count(line, "NumTabs");
    if (key == "re") reynolds_.push_back(line.words[0].text);
    if (key == "interpord" && line.words[0].text == "3") {
      report_.add(assumed, path_.string() + ": linear between angles, InterpOrd is cubic");
    }
    if (key == "numalf") read_table(count(line, "NumAlf"));
    if (found_ > 0) return;
    for (const auto& [name, value] : constants) {
      const auto given = find_number(line.words[0].text);
      if (key == to_lower(name) && given && *given != value) {
        others_.push_back(fmt::format("{} = {:g}", name, *given));
      }
    }
  }

  // The rows behind this line; those of the first table are kept.
  void read_table(int count) {
    const Line& head = lines_[at_];
    for (int i = 0; i < count; ++i) {
      if (++at_ == lines_.size()) {
        throw mistake(head, "NumAlf", fmt::format("announces {} rows, found {}", count, i));
      }
      const AirfoilRow row = row_of(lines_[at_]);
      if (found_ == 0) add(row);
    }
    ++found_;
  }

  AirfoilRow row_of(const Line& line) const {
    const auto number = [&](int column, const char* name) {
      const auto index = static_cast<std::size_t>(column) - 1;
      const auto value = index < line.words.size() && !line.words[index].quoted
                             ? find_number(line.words[index].text)
                             : std::nullopt;
      if (!value) {
        throw mistake(line, name, fmt::format("must be a number in column {}", column));
      }
      return *value;
    };
    AirfoilRow row{degree * number(columns_.angle, "alpha"), number(columns_.lift, "Cl"),
                   number(columns_.drag, "Cd"), 0.0};
    if (columns_.moment > 0) row.moment = number(columns_.moment, "Cm");
    return row;
  }

  void add(const AirfoilRow& row) {
    if (!rows_.empty() && row.angle <= rows_.back().angle) {
      throw mistake(lines_[at_], "alpha",
                    fmt::format("angles must rise, got {:g} after {:g} degrees", row.angle / degree,
                                rows_.back().angle / degree));
    }
    rows_.push_back(row);
  }

  void check_ends() const {
    constexpr double half = std::numbers::pi;
    const AirfoilRow &first = rows_.front(), &last = rows_.back();
    if (rows_.size() < 3 || std::abs(first.angle + half) > closing_angle ||
        std::abs(last.angle - half) > closing_angle) {
      throw InputError(
          {path_.string(), 0, "alpha"},
          fmt::format("must reach from -180 to 180 degrees in at least three rows, got "
                      "{:g} to {:g} in {}",
                      first.angle / degree, last.angle / degree, rows_.size()));
    }
    const double gap = std::max({std::abs(first.lift - last.lift), std::abs(first.drag - last.drag),
                                 std::abs(first.moment - last.moment)});
    if (gap > closing_coefficient) {
      throw InputError({path_.string(), 0, "alpha"},
                       fmt::format("coefficients must be the same at -180 and 180 degrees, they "
                                   "differ by {:g}",
                                   gap));
    }
  }

  const std::filesystem::path& path_;
  const AirfoilColumns& columns_;
  Report& report_;
  std::vector<Line> lines_;
  std::size_t at_ = 0;
  int announced_ = 0, found_ = 0;
  std::vector<std::string> reynolds_, others_;
  std::vector<AirfoilRow> rows_;
};

// What lists of a deck can hold.
std::string plain(std::string name) {
  for (char& c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) == 0 && c != '-' && c != ' ') c = '_';
  }
  return name.empty() ? "airfoil" : name;
}

}  // namespace

AirfoilFile read_airfoil(const std::filesystem::path& path, const AirfoilColumns& columns,
                         Report& report) {
  return {path, plain(path.stem().string()), Reader(path, columns, report).read()};
}

}  // namespace culm::openfast
