#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/base/text.hpp>
#include <culm/openfast/moordyn.hpp>
#include <culm/openfast/text_table.hpp>

#include "entries.hpp"
#include "file_end.hpp"
#include "headings.hpp"
#include "words.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

namespace culm::openfast {

namespace {

// Its dictionary has a damping that MoorDyn's has not.
bool is_of_map(const InputFile& file) {
  const std::vector<std::string> columns = file.columns_below("LINE DICTIONARY");
  return std::any_of(columns.begin(), columns.end(),
                     [](const std::string& column) { return to_lower(column) == "cintdamp"; });
}

// What is not imported changes what lines hold.
void leave_out(const Where& where, const std::string& what, MoorDyn& moorings, Report& report) {
  moorings.left_out.push_back({where, what});
  report.add(missing, to_string(where) + ": " + what);
}

// A table below a heading. In version 1 a line with its count comes first.
// @param is_whole  whether each row must be as long as the first; a value of MAP++ may be '#',
// behind which nothing is read
TextTable read_section(const InputFile& file, std::initializer_list<const char*> headings,
                       const std::string& what, bool is_whole = true) {
  for (const char* heading : headings) {
    if (!file.has_heading(heading)) continue;
    std::vector<TextRow> rows = file.rows_below(heading);
    std::optional<int> count;
    if (!rows.empty()) {
      if (const auto number = find_number(rows.front().words.front())) {
        count = static_cast<int>(*number);
        rows.erase(rows.begin());
      }
    }
    const std::size_t columns = rows.empty() ? 0 : rows.front().words.size();
    for (const TextRow& row : rows) {
      if (!is_whole || row.words.size() == columns || row.words.front().front() == '(') continue;
      throw InputError(file.where(row.line, what),
                       fmt::format("must have {} columns, found {}", columns, row.words.size()));
    }
    TextTable table(file, what, std::move(rows), count);
    if (table.size() > 0) return table;
  }
  throw InputError(file.where(0, what), "there is no table of them, or it is empty");
}

// Below a heading, without the names of columns and their units.
std::size_t count_below(const InputFile& file, const std::string& heading) {
  const std::vector<TextRow> rows = file.rows_below(heading);
  return rows.size() > 2 ? rows.size() - 2 : 0;
}

// Static stiffness, which others may follow after a bar.
double read_stiffness(const TextTable& table, std::size_t row, Report& report) {
  std::string word = table.text(row, {"EA"});
  if (const std::size_t bar = word.find('|'); bar != std::string::npos) {
    report.add(not_used, to_string(table.where(row, {"EA"})) + ": dynamic stiffness, " + word);
    word.resize(bar);
  }
  const auto value = find_number(word);
  if (value && *value > 0.0) return *value;
  throw InputError(table.where(row, {"EA"}),
                   "'" + word + "' must be a number > 0; tables of tension are not imported");
}

std::vector<LineType> read_types(const InputFile& file, Report& report) {
  const TextTable table = read_section(file, {"LINE TYPES", "LINE DICTIONARY"}, "line type");
  std::vector<LineType> types;
  for (std::size_t i = 0; i < table.size(); ++i) {
    types.push_back({table.text(i, {"Name", "LineType", "TypeName"}),
                     positive(table, i, {"Diam", "Diameter"}),
                     positive(table, i, {"MassDen", "MassDenInAir", "Mass/m"}),
                     read_stiffness(table, i, report), table.number(i, {"CB"}, 0.0)});
    if (types.back().friction < 0.0) {
      throw InputError(table.where(i, {"CB"}),
                       fmt::format("must be >= 0, got {:g}", types.back().friction));
    }
    if (table.number(i, {"EI"}, 0.0) != 0.0) {
      report.add(not_used, to_string(table.where(i, {"EI"})) + ": stiffness in bending");
    }
  }
  return types;
}

// MAP++ says "depth" for the bed.
double read_height(const TextTable& table, std::size_t row, const std::optional<double>& depth) {
  if (to_lower(table.text(row, {"Z"})) != "depth") return table.number(row, {"Z"});
  if (depth) return -*depth;
  throw InputError(table.where(row, {"Z"}),
                   "is 'depth', but no file beside this one says how deep the water is");
}

std::vector<MooringPoint> read_points(const InputFile& file, const Surroundings& surroundings,
                                      MoorDyn& moorings, Report& report) {
  const TextTable table =
      read_section(file, {"POINTS", "POINT PROPERTIES", "CONNECTION PROPERTIES", "NODE PROPERTIES"},
                   "point", !is_of_map(file));
  index_rows(table, {"ID", "Node", "Point"});
  std::vector<MooringPoint> points;
  for (std::size_t i = 0; i < table.size(); ++i) {
    MooringPoint point;
    point.id = table.integer(i, {"ID", "Node", "Point"});
    const std::string word = to_lower(table.text(i, {"Attachment", "Type"}));
    const auto is = [&](std::initializer_list<const char*> words) {
      return std::find(words.begin(), words.end(), word) != words.end();
    };
    if (is({"fixed", "fix", "anchor"})) {
      point.kind = MooringPoint::Kind::fixed;
    } else if (is({"vessel", "coupled", "cpld", "ves"})) {
      point.kind = MooringPoint::Kind::vessel;
    } else if (is({"free", "connect", "con", "point"}) || word.starts_with("body") ||
               word.starts_with("turbine")) {
      point.kind = MooringPoint::Kind::free;
    } else {
      throw InputError(table.where(i, {"Attachment"}),
                       "unknown '" + word + "'" +
                           did_you_mean(word, {"fixed", "vessel", "coupled", "free", "connect"}));
    }
    point.place = {table.number(i, {"X"}), table.number(i, {"Y"}),
                   read_height(table, i, surroundings.depth)};
    if (point.kind == MooringPoint::Kind::free) {
      leave_out(
          table.where(i, {"Attachment"}),
          fmt::format("point {} is '{}'; lines that end there are not in the deck", point.id, word),
          moorings, report);
    }
    points.push_back(point);
  }
  return points;
}

std::size_t find_point(const MoorDyn& moorings, const TextTable& table, std::size_t row,
                       TextTable::Names names) {
  const int id = table.integer(row, names);
  for (std::size_t i = 0; i < moorings.points.size(); ++i) {
    if (moorings.points[i].id == id) return i;
  }
  throw InputError(table.where(row, names), fmt::format("there is no point {}", id));
}

// Ends on rods have a name such as R1A instead of a number.
bool ends_on_rod(const std::string& end) {
  return (end.starts_with("R") || end.starts_with("r")) && !find_number(end);
}

// Whether a line of MAP++ has a flag, behind its columns.
bool has_flag(const TextTable& table, std::size_t row, const char* flag) {
  const std::vector<std::string>& words = table.row(row).words;
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return to_lower(word) == flag; });
}

void read_lines(const InputFile& file, MoorDyn& moorings, Report& report) {
  // in MAP++ each has as many flags as it wants
  const TextTable table =
      read_section(file, {"- LINES", "LINE PROPERTIES"}, "line", !is_of_map(file));
  index_rows(table, {"ID", "Line"});
  std::vector<std::string> names;
  for (const LineType& type : moorings.types) names.push_back(type.name);
  for (std::size_t i = 0; i < table.size(); ++i) {
    MooringLine line;
    line.id = table.integer(i, {"ID", "Line"});
    const std::string type = table.text(i, {"LineType"});
    const auto found = std::find(names.begin(), names.end(), type);
    if (found == names.end()) {
      throw InputError(table.where(i, {"LineType"}),
                       "unknown line type '" + type + "'" + did_you_mean(type, names));
    }
    line.type = static_cast<std::size_t>(found - names.begin());
    line.length = positive(table, i, {"UnstrLen"});
    if (ends_on_rod(table.text(i, {"AttachA", "NodeAnch", "NodeA"})) ||
        ends_on_rod(table.text(i, {"AttachB", "NodeFair", "NodeB"}))) {
      leave_out(table.where(i, {"AttachA"}),
                fmt::format("line {} ends on a rod, and is not in the deck", line.id), moorings,
                report);
      continue;
    }
    if (has_flag(table, i, "linear_spring")) {
      leave_out(table.where(i, {"Flags"}),
                fmt::format("line {} is a linear spring, and is not in the deck", line.id),
                moorings, report);
      continue;
    }
    if (has_flag(table, i, "omit_contact")) {
      report.add(missing,
                 fmt::format("{}: line {} hangs through the seabed there (omit_contact), and lies "
                             "on it here",
                             to_string(table.where(i, {"Flags"})), line.id));
    }
    line.points = {find_point(moorings, table, i, {"AttachA", "NodeAnch", "NodeA"}),
                   find_point(moorings, table, i, {"AttachB", "NodeFair", "NodeB"})};
    moorings.lines.push_back(line);
  }
}

// MAP++ makes the lines again, turned about z.
void repeat_lines(const InputFile& file, MoorDyn& moorings) {
  const std::size_t points = moorings.points.size(), lines = moorings.lines.size();
  int next_point = 0, next_line = 0;
  for (const MooringPoint& point : moorings.points) next_point = std::max(next_point, point.id);
  for (const MooringLine& line : moorings.lines) next_line = std::max(next_line, line.id);
  for (const TextRow& row : file.rows_below("OPTIONS")) {
    if (to_lower(row.words.front()) != "repeat") continue;
    for (std::size_t k = 1; k < row.words.size(); ++k) {
      const auto degrees = find_number(row.words[k]);
      if (!degrees) {
        throw InputError(file.where(row.line, "repeat"),
                         "must be angles in degrees, got '" + row.words[k] + "'");
      }
      const Eigen::AngleAxisd turn(*degrees * std::numbers::pi / 180.0, Vec3::UnitZ());
      const std::size_t first = moorings.points.size();
      for (std::size_t i = 0; i < points; ++i) {
        MooringPoint point = moorings.points[i];
        point.id = ++next_point;
        point.place = turn * point.place;
        moorings.points.push_back(point);
      }
      for (std::size_t i = 0; i < lines; ++i) {
        MooringLine line = moorings.lines[i];
        line.id = ++next_line;
        for (std::size_t& end : line.points) end += first;
        moorings.lines.push_back(line);
      }
    }
  }
}

// A value of the options, whose lines are 'value keyword'.
double option(const InputFile& file, std::initializer_list<const char*> keywords,
              const std::optional<double>& there, double otherwise, const std::string& what,
              Report& report) {
  for (const TextRow& row : file.rows_below("OPTIONS")) {
    for (const char* keyword : keywords) {
      if (row.words.size() < 2 || to_lower(row.words[1]) != to_lower(keyword)) continue;
      const auto value = find_number(row.words[0]);
      if (value && *value > 0.0) return *value;
      throw InputError(file.where(row.line, keyword),
                       "must be a number > 0, got '" + row.words[0] + "'");
    }
  }
  if (there) return *there;
  report.add(assumed, fmt::format("{} {:g}, which this file does not say", what, otherwise));
  return otherwise;
}

}  // namespace

double wet_weight(const MoorDyn& file, const LineType& type) {
  const double area = 0.25 * std::numbers::pi * type.diameter * type.diameter;
  return (type.mass - file.density * area) * file.gravity;
}

MoorDyn read_moordyn(const std::filesystem::path& path, Report& report) {
  return read_moordyn(path, find_surroundings(path), report);
}

MoorDyn read_moordyn(const std::filesystem::path& path, const Surroundings& surroundings,
                     Report& report) {
  const InputFile file(path);
  MoorDyn moorings;
  moorings.path = path;
  const bool is_map = is_of_map(file);
  moorings.title = is_map ? "Mooring lines" : file.title();
  moorings.gravity =
      option(file, {"g", "gravity"}, surroundings.gravity, 9.80665, "gravity [m/s^2]", report);
  moorings.density = option(file, {"WtrDnsty", "rhoW", "rho", "WtrDens"}, surroundings.density,
                            1025.0, "density of the water [kg/m^3]", report);
  moorings.types = read_types(file, report);
  moorings.points = read_points(file, surroundings, moorings, report);
  read_lines(file, moorings, report);
  repeat_lines(file, moorings);
  for (const char* heading : {"BODIES", "BODY LIST", "RODS", "ROD LIST", "CONTROL", "FAILURE"}) {
    const std::size_t count = file.has_heading(heading) ? count_below(file, heading) : 0;
    if (count == 0) continue;
    leave_out(file.where(0, heading),
              fmt::format("{} lines below {} are not in the deck", count, heading), moorings,
              report);
  }
  if (!is_map) {
    check_end(file, report);
  } else if (file.rows_below("SOLVER OPTIONS").empty()) {
    report.add(unknown, path.string() + ": has no options at its end; it may have been cut off");
  }
  report.add(read, fmt::format("{}: {}, {} types of lines, {} points, {} lines", path.string(),
                               is_map ? "MAP++" : "MoorDyn", moorings.types.size(),
                               moorings.points.size(), moorings.lines.size()));
  return moorings;
}

}  // namespace culm::openfast
