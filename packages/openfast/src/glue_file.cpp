#include <culm/base/error.hpp>
#include <culm/openfast/glue_file.hpp>
#include <culm/openfast/input_file.hpp>

#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <system_error>

namespace culm::openfast {

namespace {

struct Module {
  const char* name;
  const char* flag;
  const char* file;
};
constexpr Module carriers[] = {{"HydroDyn", "CompHydro", "HydroFile"},
                               {"SubDyn", "CompSub", "SubFile"},
                               {"mooring", "CompMooring", "MooringFile"},
                               {"ice", "CompIce", "IceFile"}};

bool is_on(InputFile& file, const char* flag) { return file.number(flag, 0.0) != 0.0; }

bool are_same(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;  // one that does not exist is not the same
  return std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

GlueFile read_glue_file(const std::filesystem::path& path) {
  InputFile file(path);
  GlueFile glue;
  glue.path = path;
  glue.elastodyn = file.file("EDFile");
  if (is_on(file, "CompServo")) glue.servodyn = file.file("ServoFile");
  if (file.number("CompElast", 1.0) == 2.0) glue.beamdyn = file.file("BDBldFile(1)");
  if (file.has("Gravity")) glue.gravity = file.number("Gravity");
  for (const Module& module : carriers) {
    if (is_on(file, module.flag)) {
      glue.substructure.push_back(
          fmt::format("{} ({})", module.name, file.file(module.file).filename().string()));
    }
  }
  return glue;
}

std::optional<GlueFile> find_glue_file(const std::filesystem::path& elastodyn, Report& report) {
  const auto folder = elastodyn.has_parent_path() ? elastodyn.parent_path() : ".";
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".fst") continue;
    InputFile file(entry.path());
    if (file.has("EDFile") && are_same(file.file("EDFile"), elastodyn))
      found.push_back(entry.path());
  }
  if (found.empty()) return std::nullopt;
  std::sort(found.begin(), found.end());
  if (found.size() > 1) {
    report.add(assumed, fmt::format("{} files beside {} name it: {} is taken; give another one "
                                    "itself to import it",
                                    found.size(), elastodyn.filename().string(),
                                    found.front().filename().string()));
  }
  return read_glue_file(found.front());
}

YawDrive read_yaw_drive(const std::filesystem::path& path, Report& report) {
  constexpr double degree = std::numbers::pi / 180.0;
  InputFile file(path);
  YawDrive drive{path, file.number("YawSpr"), file.number("YawDamp"),
                 degree * file.number("YawNeut")};
  for (const char* name : {"YawSpr", "YawDamp"}) {
    if (!(file.number(name) >= 0.0)) {
      throw InputError(file.where(name), fmt::format("must be >= 0, got {:g}", file.number(name)));
    }
  }
  report.add(read,
             fmt::format("{}: ServoDyn, of it the yaw drive: spring {:g} N m/rad, damper {:g} "
                         "N m s/rad, neutral at {:g} degrees",
                         path.string(), drive.stiffness, drive.damping, drive.neutral / degree));
  if (file.number("YCMode", 0.0) != 0.0) {
    report.add(not_used, fmt::format("{}: yaw control, YCMode = {:g}: the neutral angle stays",
                                     to_string(file.where("YCMode")), file.number("YCMode")));
  }
  return drive;
}

}  // namespace culm::openfast
