#include <culm/base/error.hpp>
#include <culm/openfast/inflow.hpp>
#include <culm/openfast/input_file.hpp>

#include "degree.hpp"
#include "entries.hpp"
#include "headings.hpp"
#include "inflow_boxes.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

namespace culm::openfast {

namespace {

void read_steady(InputFile part, Wind& wind, Report& report) {
  wind.speed = non_negative(part, "HWindSpeed");
  wind.height = positive(part, "RefHt");
  wind.exponent = non_negative(part, "PLExp");
  report.add(unknown, part.unread());
}

void read_table(InputFile part, Wind& wind, Report& report) {
  wind.kind = Wind::Kind::table;
  wind.file = part.file(name_of(part, "Filename_Uni", "Filename"));
  wind.height = positive(part, name_of(part, "RefHt_Uni", "RefHt"));
  wind.length = positive(part, "RefLength");
  report.add(unknown, part.unread());
}

void read_box(InputFile part, Wind& wind, Report& report) {
  wind.kind = Wind::Kind::box;
  wind.file = part.file(name_of(part, "FileName_BTS", "Filename"));
  report.add(unknown, part.unread());
}

// The middle between the lowest and the highest points of a box, as its header has them: 32-bit
// numbers of points, 32-bit floats of lengths.
double middle_of_box(const std::filesystem::path& path) {
  constexpr std::size_t points_upwards = 2, spacing_upwards = 18, lowest_point = 38;
  std::array<char, lowest_point + sizeof(float)> header{};
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), header.size());
  const auto at = [&header]<class T>(std::size_t place, T number) {
    std::memcpy(&number, header.data() + place, sizeof number);
    return static_cast<double>(number);
  };
  const double middle = at(lowest_point, 0.0F) + 0.5 * (at(points_upwards, std::int32_t{}) - 1.0) *
                                                     at(spacing_upwards, 0.0F);
  if (!file || !std::isfinite(middle)) {
    throw FileError(path.string(), "is no box of TurbSim: its header has no height");
  }
  return middle;
}

void make_still(Wind& wind, double height) {
  Wind still;
  still.height = height;
  still.direction = wind.direction;
  still.upflow = wind.upflow;
  wind = still;
}

// The first file of a wind that is not there.
std::filesystem::path missing_file(const Wind& wind) {
  std::vector<std::filesystem::path> files = wind.mann.files;
  if (!wind.file.empty()) files.push_back(wind.file);
  for (const auto& file : files) {
    if (!std::filesystem::is_regular_file(file)) return file;
  }
  return {};
}

}  // namespace

Wind read_inflow(const std::filesystem::path& path, double height, Report& report) {
  InputFile file(path);
  InputFile general = file.part("");
  Wind wind;
  report.add(read, fmt::format("{}: InflowWind; '{}'", path.string(), file.title()));
  const int type = general.integer("WindType");
  if (type < 1 || type > 7) {
    throw InputError(file.where("WindType"), fmt::format("must be from 1 to 7, got {}", type));
  }
  const std::string place = fmt::format("{} = {}", to_string(file.where("WindType")), type);
  if (type != 7) {
    wind.direction = degree * general.number("PropagationDir");
    wind.upflow = degree * general.number("VFlowAng", 0.0);
  }
  if (type == 1) read_steady(file.part("Steady"), wind, report);
  if (type == 2) read_table(file.part("Uniform"), wind, report);
  if (type == 3) read_box(file.part("TurbSim"), wind, report);
  if (type == 4) read_bladed_style(file, wind, report);
  if (type == 5) read_mann(file, wind, report);
  if (type == 7) read_native_bladed(file, wind, report);
  if (type == 6) {
    make_still(wind, height);
    report.add(missing,
               place +
                   ": a wind of a user's routine; the air stands still. A box of turbulence "
                   "(WindType 3, 4, 5, 7) can be imported, or set the variable V, the speed at "
                   "the hub");
  }
  if (const std::filesystem::path gone = missing_file(wind); !gone.empty()) {
    report.add(missing,
               fmt::format("{}: names {}, which is not there; the air stands still. Set the "
                           "variable V, the speed at the hub",
                           place, gone.string()));
    make_still(wind, height);
  }
  if (wind.kind == Wind::Kind::box) {
    wind.centre = middle_of_box(wind.file);
    if (std::abs(wind.centre - height) > 1e-3 * height) {
      report.add(read, fmt::format("{}: the middle of the box is {:g} m high, the hub {:g} m",
                                   wind.file.string(), wind.centre, height));
    }
  }
  if (general.has("VelInterpCubic") && general.flag("VelInterpCubic")) {
    report.add(assumed, to_string(general.where("VelInterpCubic")) +
                            " True: velocities are linear in time all the same");
  }
  general.ignore({"Echo", "NWindVel", "WindVxiList", "WindVyiList", "WindVziList", "VFlowAng",
                  "PropagationDir"});
  report.add(unknown, general.unread());
  return wind;
}

}  // namespace culm::openfast
