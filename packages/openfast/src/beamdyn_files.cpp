#include <culm/base/error.hpp>
#include <culm/openfast/beamdyn.hpp>
#include <culm/openfast/input_file.hpp>

#include "degree.hpp"
#include "headings.hpp"
#include "section_checks.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

namespace culm::openfast {

namespace {

void finish(const InputFile& file, Report& report) { report.add(unknown, file.unread()); }

Vec3 read_vector(InputFile& file, const std::string& name, int first) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = file.number(fmt::format("{}({})", name, first + i));
  return v;
}

Mat6 read_matrix(const std::vector<NumberRow>& rows, std::size_t first, const InputFile& file,
                 const std::string& what) {
  Mat6 matrix;
  for (std::size_t i = 0; i < 6; ++i) {
    const NumberRow& row = rows[first + i];
    if (row.values.size() != 6) {
      throw InputError(file.where(row.line, what),
                       fmt::format("row {} of the matrix must have 6 numbers, got {}", i + 1,
                                   row.values.size()));
    }
    matrix.row(static_cast<int>(i)) = Eigen::Map<const Vec6>(row.values.data());
  }
  return matrix;
}

// Each station has a line with its place, six of the stiffness and six of the mass.
std::vector<BladeStation> read_stations(InputFile& file) {
  const int count = file.integer("station_total");
  const auto rows = file.numbers_below("Distributed Properties");
  constexpr std::size_t lines = 13;
  if (count < 2 || rows.size() != lines * static_cast<std::size_t>(count)) {
    throw InputError(file.where("station_total"),
                     fmt::format("announces {} stations of {} lines of numbers (at least 2), but "
                                 "below Distributed Properties there are {} lines",
                                 count, lines, rows.size()));
  }
  std::vector<BladeStation> stations;
  for (std::size_t at = 0; at < rows.size(); at += lines) {
    const NumberRow& place = rows[at];
    const std::string name = fmt::format("station {}", at / lines + 1);
    if (place.values.size() != 1) {
      throw InputError(
          file.where(place.line, name),
          fmt::format("must begin with its place alone, got {} numbers", place.values.size()));
    }
    stations.push_back({place.values.front(), read_matrix(rows, at + 1, file, name + ", stiffness"),
                        read_matrix(rows, at + 7, file, name + ", mass"), place.line});
  }
  return stations;
}

void check_places(const BeamDynBlade& blade) {
  const auto& stations = blade.stations;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Where where{blade.path.string(), stations[i].line, fmt::format("station {}", i + 1)};
    if (i > 0 && stations[i].span <= stations[i - 1].span) {
      throw InputError(where, fmt::format("places must rise, got {:g} after {:g}", stations[i].span,
                                          stations[i - 1].span));
    }
    const bool last = i + 1 == stations.size();
    if ((i == 0 && stations[i].span != 0.0) || (last && stations[i].span != 1.0)) {
      throw InputError(where, fmt::format("the {} place must be {}, got {:g}",
                                          last ? "last" : "first", last ? 1 : 0, stations[i].span));
    }
  }
}

void read_damping(InputFile& file, BeamDynBlade& blade, Report& report) {
  // the older name has the same values
  const std::string keyword = file.has("damp_type") ? "damp_type" : "damp_flag";
  const int type = file.integer(keyword);
  file.ignore({"n_modes", "zeta"});
  if (type == 1) {
    const auto rows = file.numbers_below("Damping");
    if (rows.empty() || rows.front().values.size() != 6) {
      throw InputError(file.where(keyword), "announces six damping coefficients mu, there are not");
    }
    std::copy_n(rows.front().values.begin(), 6, blade.damping.begin());
  } else if (type == 2) {
    report.add(assumed, "damp_type 2, damping of modes, has no counterpart in culm: no mu");
  } else if (type != 0) {
    throw InputError(file.where(keyword), fmt::format("must be 0, 1 or 2, got {}", type));
  }
}

BeamDynBlade read_beamdyn_blade(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  BeamDynBlade blade{path, file.title(), read_stations(file), {}};
  check_places(blade);
  read_damping(file, blade, report);
  report.add(read, fmt::format("{}: BeamDyn blade, {} stations; '{}'", path.string(),
                               blade.stations.size(), blade.title));
  check_stations(blade, report);
  finish(file, report);
  return blade;
}

std::vector<KeyPoint> read_key_points(InputFile& file) {
  const int count = file.integer("kp_total");
  if (count < 3) {
    throw InputError(file.where("kp_total"), fmt::format("must be at least 3, got {}", count));
  }
  std::vector<KeyPoint> points;
  for (const NumberRow& row : file.table("kp_total", count, 4, "key points")) {
    points.push_back({Eigen::Map<const Vec3>(row.values.data()), row.values[3] * degree});
    if (points.size() > 1 && points.back().position == points[points.size() - 2].position) {
      throw InputError(
          file.where(row.line, "key points"),
          fmt::format("points {} and {} are the same", points.size() - 1, points.size()));
    }
  }
  return points;
}

// Lines "member, number of its key points"; neighbours share a point.
void check_members(InputFile& file, const BeamDyn& beam) {
  int sum = 1;
  int found = 0;
  for (const NumberRow& row : file.numbers_below("GEOMETRY")) {
    if (row.values.size() != 2) continue;
    sum += static_cast<int>(row.values[1]) - 1;
    ++found;
  }
  const int points = static_cast<int>(beam.key_points.size());
  if (found != beam.members || sum != points) {
    throw InputError(file.where("kp_total"),
                     fmt::format("contradiction: {} key points, but {} members are announced and "
                                 "the {} below have {} points together",
                                 points, beam.members, found, sum));
  }
}

}  // namespace

BeamDyn read_beamdyn(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  BeamDyn beam;
  beam.path = path;
  beam.title = file.title();
  beam.members = file.integer("member_total");
  beam.key_points = read_key_points(file);
  check_members(file, beam);
  beam.order = file.integer("order_elem");
  report.add(read, fmt::format("{}: BeamDyn, {} key points; '{}'", path.string(),
                               beam.key_points.size(), beam.title));
  if (beam.members > 1) {
    report.add(assumed, fmt::format("{}: the {} members go on into each other smoothly",
                                    path.string(), beam.members));
  }
  if (file.has("UsePitchAct") && file.flag("UsePitchAct")) {
    report.add(assumed, fmt::format("{}: the pitch actuator is left out", path.string()));
  }
  const std::vector<std::string> numerics{
      "Echo",       "QuasiStaticInit", "analysis_type", "rhoinf",        "quadrature",
      "refine",     "n_fact",          "DTBeam",        "load_retries",  "NRMax",
      "stop_tol",   "tngt_stf_fd",     "tngt_stf_comp", "tngt_stf_pert", "tngt_stf_difftol",
      "RotStates",  "PitchJ",          "PitchK",        "PitchC",        "SumPrint",
      "OutFmt",     "NNodeOuts",       "OutNd",         "BldNd_BlOutNd", "BldNd_BladesOut",
      "UsePitchAct"};
  file.ignore(numerics);
  report.add(not_used,
             fmt::format("{}: what concerns BeamDyn's numerics and outputs (order_elem {})",
                         path.string(), beam.order));
  beam.blade = read_beamdyn_blade(file.file("BldFile"), report);
  finish(file, report);
  return beam;
}

namespace {

Mat3 read_axes(InputFile& file) {
  Mat3 cosines;
  const auto rows = file.table("GlbPos(3)", 3, 3, "GlbDCM");
  for (int i = 0; i < 3; ++i) {
    cosines.row(i) = Eigen::Map<const Vec3>(rows[static_cast<std::size_t>(i)].values.data());
  }
  constexpr double slip = 1e-5;  // files have seven digits
  if (!(cosines * cosines.transpose()).isIdentity(slip) || cosines.determinant() < 0.0) {
    throw InputError(file.where(rows.front().line, "GlbDCM"), "must be a rotation");
  }
  return cosines.transpose();
}

void read_loads(InputFile& file, BeamDynDriver& driver) {
  driver.line_force = read_vector(file, "DistrLoad", 1);
  driver.line_moment = read_vector(file, "DistrLoad", 4);
  const PointLoad tip{1.0, read_vector(file, "TipLoad", 1), read_vector(file, "TipLoad", 4)};
  if (!tip.force.isZero(0.0) || !tip.moment.isZero(0.0)) driver.point_loads.push_back(tip);
  const int count = file.has("NumPointLoads") ? file.integer("NumPointLoads") : 0;
  if (count == 0) return;
  for (const NumberRow& row : file.table("NumPointLoads", count, 7, "point loads")) {
    const double* v = row.values.data();
    if (v[0] < 0.0 || v[0] > 1.0) {
      throw InputError(file.where(row.line, "point loads"),
                       fmt::format("the place must lie between 0 and 1, got {:g}", v[0]));
    }
    driver.point_loads.push_back(
        {v[0], Eigen::Map<const Vec3>(v + 1), Eigen::Map<const Vec3>(v + 4)});
  }
}

// Old drivers leave it to the primary file; older ones always march in time.
bool read_is_dynamic(InputFile& file, const std::filesystem::path& primary, Report& report) {
  if (file.has("DynamicSolve")) return file.flag("DynamicSolve");
  InputFile old(primary);
  if (old.has("analysis_type")) return old.integer("analysis_type") == 2;
  report.add(assumed, "neither DynamicSolve nor analysis_type is given: a dynamic analysis");
  return true;
}

}  // namespace

BeamDynDriver read_beamdyn_driver(const std::filesystem::path& path, Report& report) {
  InputFile file(path);
  report.add(read, fmt::format("{}: BeamDyn driver; '{}'", path.string(), file.title()));
  BeamDynDriver driver;
  driver.path = path;
  driver.title = file.title();
  const auto primary = file.file("InputFile");
  driver.dynamic = read_is_dynamic(file, primary, report);
  driver.start = file.number("t_initial");
  driver.end = file.number("t_final");
  driver.step = file.number("dt");
  if (driver.dynamic && !(driver.step > 0.0 && driver.end > driver.start)) {
    throw InputError(file.where("dt"),
                     fmt::format("a dynamic analysis needs t_final > t_initial and dt > 0, got "
                                 "{:g}, {:g}, {:g}",
                                 driver.end, driver.start, driver.step));
  }
  for (int i = 0; i < 3; ++i) {
    driver.gravity[i] = file.number(std::string("G") + "xyz"[i]);
  }
  driver.root = read_vector(file, "GlbPos", 1);
  driver.axes = read_axes(file);
  driver.angular_velocity = read_vector(file, "RootVel", 4);
  read_loads(file, driver);
  file.ignore({"GlbRotBladeT0", "WrVTK", "VTK_fps"});
  driver.beam = read_beamdyn(primary, report);
  finish(file, report);
  return driver;
}

}  // namespace culm::openfast
