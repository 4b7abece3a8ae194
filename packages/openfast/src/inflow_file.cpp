#include <culm/base/error.hpp>
#include <culm/openfast/inflow.hpp>
#include <culm/openfast/input_file.hpp>

#include "headings.hpp"

#include <fmt/format.h>

#include <numbers>

namespace culm::openfast {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

double positive(InputFile& file, const char* keyword) {
  const double value = file.number(keyword);
  if (!(value > 0.0)) {
    throw InputError(file.where(keyword), fmt::format("must be positive, got {:g}", value));
  }
  return value;
}

// Keywords that are alike in several parts of the file have endings since some year.
const char* name_of(const InputFile& file, const char* now, const char* before) {
  return file.has(now) || !file.has(before) ? now : before;
}

void read_steady(InputFile part, Wind& wind, Report& report) {
  wind.speed = part.number("HWindSpeed");
  wind.height = positive(part, "RefHt");
  wind.exponent = part.number("PLExp");
  for (const char* keyword : {"HWindSpeed", "PLExp"}) {
    if (part.number(keyword) < 0.0) {
      throw InputError(part.where(keyword),
                       fmt::format("must not be negative, got {:g}", part.number(keyword)));
    }
  }
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

void make_still(Wind& wind, double height) {
  wind.kind = Wind::Kind::power_law;
  wind.height = height;
  wind.file.clear();
}

// The mean wind that the file adds to a box for HAWC2.
void read_mean(InputFile part, Wind& wind, double height) {
  make_still(wind, height);
  wind.speed = part.number("URef");
  const int profile = part.integer("WindProfile");
  if (profile == 2) wind.exponent = part.number(name_of(part, "PLExp_Hawc", "PLExp"));
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
  if (type == 5) {
    const double reference =
        file.part("HAWC-format binary").number(file.has("RefHt_Hawc") ? "RefHt_Hawc" : "RefHt");
    read_mean(file.part("Mean wind profile"), wind, reference);
    report.add(missing, place +
                            ": the turbulence of boxes for HAWC2; the mean wind of the file is "
                            "taken. A box of TurbSim (WindType 3) can be imported");
  }
  if (type == 4 || type == 6 || type == 7) {
    make_still(wind, height);
    report.add(
        missing,
        fmt::format("{}: {}; the air stands still. A box of TurbSim (WindType 3) can be "
                    "imported, or set the variable V, the speed at the hub",
                    place, type == 6 ? "a wind of a user's routine" : "boxes in Bladed's format"));
  }
  if (!wind.file.empty() && !std::filesystem::is_regular_file(wind.file)) {
    report.add(missing,
               fmt::format("{}: names {}, which is not there; the air stands still. Set the "
                           "variable V, the speed at the hub",
                           place, wind.file.string()));
    make_still(wind, height);
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
