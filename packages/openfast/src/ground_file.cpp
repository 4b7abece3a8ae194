#include "ground_file.hpp"

#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>

#include "headings.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace culm::openfast {

namespace {

constexpr const char* directions[] = {"x", "y", "z", "tx", "ty", "tz"};

// An entry of the upper triangle of one of the matrices.
struct Entry {
  std::string name;
  Mat6* matrix;
  int row, column;
  int line = 0;  // where it stands, or 0
};

// By their names without capitals.
std::map<std::string, Entry> entries_of(Ground& ground) {
  std::map<std::string, Entry> entries;
  for (auto [letter, matrix] : {std::pair("K", &ground.stiffness), std::pair("M", &ground.mass)}) {
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) {
        const std::string name = fmt::format("{}{}{}", letter, directions[i], directions[j]);
        entries[to_lower(name)] = {name, matrix, i, j};
      }
    }
  }
  return entries;
}

void report_absent(const std::filesystem::path& path, const std::map<std::string, Entry>& entries,
                   Report& report) {
  std::vector<std::string> stiffness, mass;
  for (const auto& [key, entry] : entries) {
    if (entry.line == 0) (key.starts_with('k') ? stiffness : mass).push_back(entry.name);
  }
  const std::size_t all = entries.size() / 2;
  if (stiffness.size() == all && mass.size() == all) {
    throw InputError({path.string(), 0, ""},
                     "has no entry of a stiffness or a mass, such as '1e9 Kxx'");
  }
  for (auto& [absent, what] : {std::pair(stiffness, "stiffness"), std::pair(mass, "mass")}) {
    if (absent.empty()) continue;
    report.add(assumed, path.string() + (absent.size() == all
                                             ? fmt::format(": no {}", what)
                                             : fmt::format(": {}: zero, for they are not there: {}",
                                                           what, join(absent, ", "))));
  }
}

}  // namespace

Ground read_ground(const std::filesystem::path& path, Report& report) {
  Ground ground;
  auto entries = entries_of(ground);
  std::istringstream stream(read_file(path));
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::vector<Word> words = split_words(line);
    const auto value = words.empty() ? std::nullopt : find_number(words[0].text);
    const auto found = words.size() < 2 ? entries.end() : entries.find(to_lower(words[1].text));
    if (found == entries.end() && value) {
      throw InputError({path.string(), number, words.size() < 2 ? "" : words[1].text},
                       "a number must have the name of its entry behind it, from Kxx to Ktztz or "
                       "Mxx to Mtztz");
    }
    if (found == entries.end()) continue;  // words of a heading
    Entry& entry = found->second;
    const Where where{path.string(), number, entry.name};
    if (!value) throw InputError(where, "must be a number, got '" + words[0].text + "'");
    if (entry.line > 0) throw InputError(where, fmt::format("stands in line {}, too", entry.line));
    entry.line = number;
    (*entry.matrix)(entry.row, entry.column) = (*entry.matrix)(entry.column, entry.row) = *value;
  }
  report_absent(path, entries, report);
  report.add(read, fmt::format("{}: ground of SubDyn, stiffness along x {:g} N/m, y {:g} N/m, z "
                               "{:g} N/m",
                               path.string(), ground.stiffness(0, 0), ground.stiffness(1, 1),
                               ground.stiffness(2, 2)));
  return ground;
}

}  // namespace culm::openfast
