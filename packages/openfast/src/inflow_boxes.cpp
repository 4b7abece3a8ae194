#include "inflow_boxes.hpp"

#include <culm/base/read_file.hpp>
#include <culm/base/text.hpp>

#include "entries.hpp"
#include "headings.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace culm::openfast {
namespace {

void read_scaling(InputFile part, Wind& wind, Report& report) {
  const int method = part.integer("ScaleMethod");
  if (method < 0 || method > 2) {
    throw InputError(part.where("ScaleMethod"), fmt::format("must be 0, 1 or 2, got {}", method));
  }
  const auto three = [&part](const std::string& name) {
    return std::vector{non_negative(part, name + "x"), non_negative(part, name + "y"),
                       non_negative(part, name + "z")};
  };
  wind.mann.loses_means = method != 0;
  if (method == 1) wind.mann.factors = three("SF");
  if (method == 2) {
    wind.mann.deviations = three("SigmaF");
    report.add(assumed, to_string(part.where("ScaleMethod")) +
                            " = 2: components get these deviations over the whole box, not in its "
                            "middle");
  }
  part.ignore({"SFx", "SFy", "SFz", "SigmaFx", "SigmaFy", "SigmaFz"});
  report.add(unknown, part.unread());
}

void read_mean(InputFile part, Wind& wind, Report& report) {
  wind.speed = positive(part, "URef");
  const int profile = part.integer("WindProfile");
  if (profile < 0 || profile > 2) {
    throw InputError(part.where("WindProfile"), fmt::format("must be 0, 1 or 2, got {}", profile));
  }
  const char* exponent = name_of(part, "PLExp_Hawc", "PLExp");
  if (profile == 2) wind.exponent = non_negative(part, exponent);
  if (profile == 1) {
    wind.roughness = positive(part, "Z0");
    if (wind.roughness >= wind.height) {
      throw InputError(part.where("Z0"), fmt::format("must be less than the reference height of "
                                                     "{:g} m, got {:g}",
                                                     wind.height, wind.roughness));
    }
  }
  wind.ahead = part.number(name_of(part, "XOffset", "InitPosition(x)"), 0.0);
  part.ignore({exponent, "Z0"});
  report.add(unknown, part.unread());
}

// The second number of a .wnd file, the kind of its spectrum; nothing if it is too short.
std::optional<int> spectrum_of(const std::filesystem::path& path) {
  const std::string bytes = read_file(path.string());
  std::int16_t number = 0;
  if (bytes.size() < 2 * sizeof(number)) return {};
  std::memcpy(&number, bytes.data() + sizeof(number), sizeof(number));
  return number;
}

// A line of the summary that TurbSim writes, with capitals only.
struct SummaryLine {
  int number = 0;
  std::string text;
};

std::vector<SummaryLine> read_summary(const std::filesystem::path& path) {
  std::istringstream stream(read_file(path.string()));
  std::vector<SummaryLine> lines;
  for (std::string line; std::getline(stream, line);) {
    for (char& c : line) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    lines.push_back({static_cast<int>(lines.size()) + 1, line});
  }
  return lines;
}

class Summary {
 public:
  explicit Summary(const std::filesystem::path& path) : path_(path), lines_(read_summary(path)) {}

  /// The first line that contains one of the texts; null if none does.
  const SummaryLine* find(const std::vector<std::string>& texts) const {
    for (const SummaryLine& line : lines_) {
      for (const std::string& text : texts) {
        if (line.text.find(text) != std::string::npos) return &line;
      }
    }
    return nullptr;
  }
  /// The number with which a line begins, or which follows an equal sign in it.
  double number(const SummaryLine* line, const std::string& what) const {
    if (line == nullptr) {
      throw InputError({path_.string(), 0, {}}, "has no line with " + what);
    }
    const std::size_t equal = line->text.find('=');
    const std::vector<double> found = leading_numbers(
        std::string_view(line->text).substr(equal == std::string::npos ? 0 : equal + 1));
    if (found.empty()) {
      throw InputError({path_.string(), line->number, {}}, "must hold a number: " + what);
    }
    return found.front();
  }
  const SummaryLine* line_after(const SummaryLine* line, int count) const {
    const auto number = static_cast<std::size_t>(line->number + count);
    return number <= lines_.size() ? &lines_[number - 1] : nullptr;
  }

 private:
  std::filesystem::path path_;
  std::vector<SummaryLine> lines_;
};

bool says_yes(const SummaryLine* line) {
  if (line == nullptr) return false;
  const std::string_view text = trim(line->text);
  return !text.empty() && (text.front() == 'T' || text.front() == 'Y' || text.substr(0, 2) == ".T");
}

// Values by their names, which may stand before or behind them.
class Scaling {
 public:
  explicit Scaling(const std::filesystem::path& path) : path_(path) {
    std::istringstream stream(read_file(path.string()));
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      const std::vector<Word> words = split_words(line.substr(0, line.find('!')));
      if (words.size() < 2) continue;
      const bool name_first = !words[0].quoted && !find_number(words[0].text);
      const auto& [name, value] =
          name_first ? std::pair(words[0], words[1]) : std::pair(words[1], words[0]);
      values_[to_lower(name.text)] = {number, value.text};
    }
  }

  std::string text(const std::string& name) { return get(name).value; }
  Where where(const std::string& name) const { return {path_.string(), get(name).line, name}; }
  /// Entries that nobody asked for.
  std::vector<InputIssue> unread() const {
    std::vector<InputIssue> issues;
    for (const auto& [name, entry] : values_) {
      if (known_.contains(name)) continue;
      issues.push_back(
          {{path_.string(), entry.line, name}, "unknown entry, left out: '" + entry.value + "'"});
    }
    return issues;
  }
  double number(const std::string& name) {
    const Entry& entry = get(name);
    const std::optional<double> found = find_number(entry.value);
    if (!found) fail(entry, name, "must be a number, got '" + entry.value + "'");
    return *found;
  }
  double number(const std::string& name, double otherwise) {
    return has(name) ? number(name) : otherwise;
  }
  double positive(const std::string& name) {
    const double value = number(name);
    if (!(value > 0.0)) fail(get(name), name, fmt::format("must be positive, got {:g}", value));
    return value;
  }

 private:
  struct Entry {
    int line = 0;
    std::string value;
  };
  bool has(const std::string& name) const { return values_.contains(to_lower(name)); }
  const Entry& get(const std::string& name) const {
    known_.insert(to_lower(name));
    const auto found = values_.find(to_lower(name));
    if (found == values_.end()) fail({}, name, "is missing");
    return found->second;
  }
  [[noreturn]] void fail(const Entry& entry, const std::string& name,
                         const std::string& what) const {
    throw InputError({path_.string(), entry.line, name}, what);
  }

  std::filesystem::path path_;
  std::map<std::string, Entry> values_;
  mutable std::set<std::string> known_;
};

}  // namespace

void read_mann(const InputFile& file, Wind& wind, Report& report) {
  InputFile part = file.part("HAWC-format binary");
  wind.kind = Wind::Kind::mann;
  for (const char* component : {"u", "v", "w"}) {
    wind.mann.files.push_back(part.file(std::string("FileName_") + component));
  }
  for (const char* axis : {"nx", "ny", "nz"}) {
    const int count = part.integer(axis);
    if (count < 2) {
      throw InputError(part.where(axis), fmt::format("must be at least 2, got {}", count));
    }
    wind.mann.points.push_back(count);
  }
  for (const char* axis : {"dx", "dy", "dz"}) wind.mann.spacing.push_back(positive(part, axis));
  wind.height = wind.centre = positive(part, name_of(part, "RefHt_Hawc", "RefHt"));
  report.add(unknown, part.unread());
  if (file.has("ScaleMethod")) read_scaling(file.part("Scaling parameters"), wind, report);
  read_mean(file.part("Mean wind profile"), wind, report);
}

void read_bladed_style(const InputFile& file, Wind& wind, Report& report) {
  InputFile part = file.part("Bladed-style");
  std::filesystem::path root = part.file(name_of(part, "FilenameRoot", "FileName_BLD"));
  if (to_lower(root.extension().string()) == ".wnd") root.replace_extension();
  if (part.has("TowerFile") && part.flag("TowerFile")) {
    report.add(missing, to_string(part.where("TowerFile")) +
                            " True: points of the tower below the grid are not used");
  }
  report.add(unknown, part.unread());
  wind.kind = Wind::Kind::bladed;
  wind.file = root.string() + ".wnd";
  const std::filesystem::path summary_path = root.string() + ".sum";
  if (!std::filesystem::is_regular_file(wind.file)) return;
  const Summary summary(summary_path);
  const SummaryLine* mean = summary.find({"UBAR"});
  const double speed = summary.number(mean, "UBar");
  std::vector<double> intensities;
  for (int i = 1; i <= 3; ++i) {
    const char* what = "the turbulence intensities, the three lines below UBar";
    intensities.push_back(0.01 * summary.number(summary.line_after(mean, i), what));
  }
  const double hub = summary.number(summary.find({"HUB HEIGHT", "ZHUB"}), "the hub height");
  const SummaryLine* offset = summary.find({"HEIGHT OFFSET"});
  wind.centre = hub - (offset == nullptr ? 0.0 : summary.number(offset, "the height offset"));
  wind.bladed.is_clockwise = says_yes(summary.find({"CLOCKWISE"}));
  wind.bladed.is_periodic = summary.find({"PERIODIC"}) != nullptr;
  wind.bladed.is_left_handed = summary.find({"BLADED LEFT-HAND RULE"}) != nullptr;
  // the header of one kind has them with more digits
  constexpr int improved_von_karman = 4;
  const bool has_them = spectrum_of(wind.file) == improved_von_karman;
  if (!has_them) wind.bladed.intensities = intensities;
  report.add(
      checked,
      fmt::format("{}: {:g} m/s; the box {}, its middle at {:g} m; points begin at the {}, "
                  "components across point to the {}; intensities {}",
                  summary_path.string(), speed, wind.bladed.is_periodic ? "repeats itself" : "ends",
                  wind.centre, wind.bladed.is_clockwise ? "left" : "right",
                  wind.bladed.is_left_handed ? "right" : "left",
                  has_them ? "of the file" : "of the summary"));
}

void read_native_bladed(const InputFile& file, Wind& wind, Report& report) {
  InputFile part = file.part("Bladed-style");
  const std::filesystem::path path = part.file(name_of(part, "FilenameRoot", "FileName_BLD"));
  part.ignore({"TowerFile"});
  report.add(unknown, part.unread());
  if (!std::filesystem::is_regular_file(path)) {
    wind.file = path;
    return;
  }
  Scaling scaling(path);
  wind.kind = Wind::Kind::bladed;
  wind.speed = scaling.positive("UBAR");
  wind.height = wind.centre = scaling.positive("REFHT");
  for (const char* name : {"TI", "TI_V", "TI_W"}) {
    wind.bladed.intensities.push_back(scaling.positive(name));
  }
  wind.direction = scaling.number("WDIR");
  wind.upflow = scaling.number("FLINC");
  wind.exponent = scaling.number("WSHEAR");
  wind.ahead = scaling.number("XOFFSET", 0.0);
  wind.file = (path.parent_path() / scaling.text("WINDF")).lexically_normal();
  wind.bladed.is_left_handed = wind.bladed.is_periodic = true;
  for (const char* shear : {"VLINSHEAR", "HLINSHEAR"}) {
    if (scaling.number(shear, 0.0) == 0.0) continue;
    report.add(not_used, fmt::format("{} = {:g}: the mean wind has no shear but that of the power "
                                     "law",
                                     to_string(scaling.where(shear)), scaling.number(shear)));
  }
  scaling.number("REFLENGTH", 0.0);  // the length of these shears
  report.add(unknown, scaling.unread());
  report.add(checked,
             fmt::format("{}: {:g} m/s at {:g} m, growing with the height to the power of "
                         "{:g}; at the start the hub is {:g} m inside the box",
                         path.string(), wind.speed, wind.height, wind.exponent, wind.ahead));
  report.add(assumed, path.string() +
                          ": values are scaled with the turbulence intensities as they "
                          "stand, as Bladed does, and not to deviations in the middle "
                          "of the box");
}

}  // namespace culm::openfast
