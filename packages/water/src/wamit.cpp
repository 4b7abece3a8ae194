#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/water/potential_body.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace culm::water {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
using Forces = Eigen::Matrix<std::complex<double>, 6, 1>;

struct Row {
  int line = 0;
  std::vector<double> values;
};

// Lines of numbers; one of words at the top is a title.
std::vector<Row> read_rows(const std::string& path, std::size_t least, std::size_t most,
                           const Where& asking) {
  std::istringstream stream(read_file(path, asking));
  std::vector<Row> rows;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    Row row{++number, {}};
    std::istringstream words(line);
    std::string word;
    bool is_numbers = true;
    while (words >> word) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      is_numbers = is_numbers && *end == '\0' && std::isfinite(value);
      row.values.push_back(value);
    }
    if (row.values.empty() || (number == 1 && !is_numbers)) continue;
    if (!is_numbers || row.values.size() < least || row.values.size() > most) {
      throw InputError({path, number, ""},
                       fmt::format("must be {} numbers{}", least, most > least ? ", or more" : ""));
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError({path, 0, ""}, "has no numbers");
  return rows;
}

int direction(const Row& row, std::size_t column, const std::string& path) {
  const double value = row.values[column];
  if (value >= 1.0 && value <= 6.0 && value == std::floor(value)) {
    return static_cast<int>(value) - 1;
  }
  throw InputError({path, row.line, ""},
                   fmt::format("directions are 1 to 6, got {:g}: only one body is read", value));
}

// Which entries there are of each owner, a period or a heading at it. None may be there twice, and
// all must have the same ones: what is missing would be zero without a word.
class Entries {
 public:
  explicit Entries(std::string path) : path_(std::move(path)) {}

  void add(const std::string& owner, const std::string& entry, int line) {
    const auto [first, is_new] = lines_[owner].try_emplace(entry, line);
    if (is_new) return;
    throw InputError({path_, line, ""},
                     fmt::format("has {}{} again, after line {}", entry, owner, first->second));
  }
  void require_all() const {
    std::map<std::string, int> known;
    for (const auto& [owner, entries] : lines_) known.insert(entries.begin(), entries.end());
    for (const auto& [owner, entries] : lines_) {
      for (const auto& [entry, line] : known) {
        if (entries.contains(entry)) continue;
        throw InputError({path_, line, ""}, fmt::format("has {} here, but not{}", entry, owner));
      }
    }
  }

 private:
  std::string path_;
  std::map<std::string, std::map<std::string, int>> lines_;  // of entries, by owner
};

std::string entry_of(int i, int j) { return fmt::format("the entry {} {}", i + 1, j + 1); }

// A number of a row in SI units.
double in_range(double value, const Row& row, const std::string& path) {
  if (std::isfinite(value)) return value;
  throw InputError({path, row.line, ""}, "is beyond the range of numbers in SI units");
}

// A length to the power in which it scales an entry, more by one for each rotation.
double power(double length, int base, int i, int j) {
  return std::pow(length, base + (i > 2 ? 1 : 0) + (j > 2 ? 1 : 0));
}

void read_radiation(const std::string& path, const WamitScale& scale, const Where& asking,
                    PotentialBody& body) {
  std::map<double, Radiation> found;
  Entries entries(path);
  bool has_limit = false;
  std::map<std::pair<int, int>, int> lines;  // of entries
  for (const Row& row : read_rows(path, 4, 5, asking)) {
    const int i = direction(row, 1, path), j = direction(row, 2, path);
    lines.try_emplace({i, j}, row.line);
    const double period = row.values[0];
    const double volume = scale.density * power(scale.length, 3, i, j);
    const double mass = in_range(volume * row.values[3], row, path);
    if (period >= 0.0) {
      entries.add(fmt::format(" at the period {} s", period), entry_of(i, j), row.line);
    }
    if (period == 0.0) {
      body.infinite_mass(i, j) = mass;
      has_limit = true;
    }
    if (period <= 0.0) continue;
    if (row.values.size() < 5) throw InputError({path, row.line, ""}, "must have its damping");
    const double frequency = in_range(two_pi / period, row, path);
    Radiation& one = found[frequency];
    one.frequency = frequency;
    one.added_mass(i, j) = mass;
    one.damping(i, j) = in_range(volume * frequency * row.values[4], row, path);
  }
  if (!has_limit) {
    throw InputError({path, 0, ""}, "lacks the added mass at infinite frequency, of period 0");
  }
  entries.require_all();
  for (const auto& [entry, line] : lines) {
    if (lines.contains({entry.second, entry.first})) continue;
    throw InputError({path, line, ""}, fmt::format("has {} here, but {} nowhere: both are the same",
                                                   entry_of(entry.first, entry.second),
                                                   entry_of(entry.second, entry.first)));
  }
  for (auto& [frequency, one] : found) body.radiation.push_back(one);
}

void read_excitation(const std::string& path, const WamitScale& scale, const Where& asking,
                     PotentialBody& body) {
  constexpr double degree = std::numbers::pi / 180.0;
  std::map<double, std::map<double, Forces>> found;  // by frequency and heading in degrees
  std::set<double> headings;
  Entries entries(path);
  for (const Row& row : read_rows(path, 7, 7, asking)) {
    const int i = direction(row, 2, path);
    const double period = row.values[0];
    if (period <= 0.0) continue;
    entries.add(fmt::format(" at the period {} s and the heading {}", period, row.values[1]),
                fmt::format("the direction {}", i + 1), row.line);
    const auto [place, fresh] = found[in_range(two_pi / period, row, path)].try_emplace(
        row.values[1], Forces(Forces::Zero()));
    headings.insert(row.values[1]);
    const double area = scale.density * scale.gravity * power(scale.length, 2, i, 0);
    place->second[i] = {in_range(area * row.values[5], row, path),
                        in_range(area * row.values[6], row, path)};
  }
  for (const double heading : headings) body.headings.push_back(degree * heading);
  for (const auto& [frequency, forces] : found) {
    Excitation one{frequency, {}};
    for (const double heading : headings) {
      const auto at = forces.find(heading);
      if (at == forces.end()) {
        throw InputError({path, 0, ""}, fmt::format("lacks the heading {:g} at the period {:g} s",
                                                    heading, two_pi / frequency));
      }
      one.forces.push_back(at->second);
    }
    body.excitation.push_back(std::move(one));
  }
  entries.require_all();
}

void read_hydrostatics(const std::string& path, const WamitScale& scale, const Where& asking,
                       PotentialBody& body) {
  Entries entries(path);
  for (const Row& row : read_rows(path, 3, 3, asking)) {
    const int i = direction(row, 0, path), j = direction(row, 1, path);
    entries.add("", entry_of(i, j), row.line);
    body.hydrostatics(i, j) = in_range(
        scale.density * scale.gravity * power(scale.length, 2, i, j) * row.values[2], row, path);
  }
}

// The interval of a rising list that holds a value, and the share of its way.
std::pair<std::size_t, double> between(const std::vector<double>& list, double value) {
  if (list.size() == 1) return {0, 0.0};
  const auto next = std::upper_bound(list.begin() + 1, list.end() - 1, value);
  const auto i = static_cast<std::size_t>(next - list.begin()) - 1;
  return {i, std::clamp((value - list[i]) / (list[i + 1] - list[i]), 0.0, 1.0)};
}

}  // namespace

PotentialBody read_wamit(const std::string& path, const WamitScale& scale, const Where& asking) {
  const std::string name = path.substr(0, path.size() - 2);
  if (!path.ends_with(".1")) {
    throw InputError(asking,
                     "must be the file of added mass and damping, NAME.1, got '" + path + "'");
  }
  PotentialBody body;
  read_radiation(path, scale, asking, body);
  read_excitation(name + ".3", scale, asking, body);
  read_hydrostatics(name + ".hst", scale, asking, body);
  return body;
}

std::optional<double> heading_in(const PotentialBody& body, double heading) {
  constexpr double near = 1e-9;
  if (body.headings.empty()) return {};
  for (const double turns : {0.0, two_pi, -two_pi}) {
    const double same = heading + turns;
    if (same >= body.headings.front() - near && same <= body.headings.back() + near) return same;
  }
  return {};
}

Forces excitation_of(const PotentialBody& body, double frequency, double heading) {
  std::vector<double> frequencies;
  for (const Excitation& one : body.excitation) frequencies.push_back(one.frequency);
  const auto [i, s] = between(frequencies, frequency);
  const auto [j, t] = between(body.headings, heading);
  const auto at = [&](std::size_t a, std::size_t b) {
    return body.excitation[std::min(a, body.excitation.size() - 1)]
        .forces[std::min(b, body.headings.size() - 1)];
  };
  return (1.0 - s) * ((1.0 - t) * at(i, j) + t * at(i, j + 1)) +
         s * ((1.0 - t) * at(i + 1, j) + t * at(i + 1, j + 1));
}

}  // namespace culm::water
