#include "turbsim_file.hpp"

#include <culm/base/read_file.hpp>

#include "binary_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>

namespace culm::flow {
namespace {

constexpr std::int16_t single = 7;
constexpr std::int16_t periodic = 8;

}  // namespace

TurbulenceGrid read_turbsim(const std::string& name, const Where& where) {
  const std::string path = (std::filesystem::path(where.file).parent_path() / name).string();
  const std::string bytes = read_file(path, where);
  BinaryReader reader(bytes, path);
  TurbulenceGrid grid;

  const auto kind = reader.take<std::int16_t>();
  if (kind != single && kind != periodic)
    reader.fail(fmt::format("is no box of TurbSim: it begins with {}, not with 7 or 8", kind));
  grid.periodic = kind == periodic;
  grid.points[1] = reader.count("number of points upwards", 2);
  grid.points[0] = reader.count("number of points across", 2);
  const int tower = reader.count("number of points of the tower", 0);
  grid.planes = reader.count("number of times", 2);
  grid.spacing[1] = reader.positive("spacing upwards");
  grid.spacing[0] = reader.positive("spacing across");
  grid.interval = reader.positive("step of time");
  grid.speed = reader.positive("mean speed");
  reader.finite("height of the hub");
  reader.finite("height of the lowest points");
  std::array<double, 3> slope{};
  std::array<double, 3> intercept{};
  for (std::size_t c = 0; c < 3; ++c) {
    slope[c] = reader.finite("slope");
    intercept[c] = reader.finite("intercept");
    if (slope[c] == 0.0) reader.fail("a slope must not be zero");
    constexpr double farthest = 32768.0;  // of the integers
    const double fastest = (farthest + std::abs(intercept[c])) / std::abs(slope[c]);
    if (fastest > std::numeric_limits<float>::max()) {
      reader.fail(
          fmt::format("a slope of {:g} makes velocities up to {:g} m/s", slope[c], fastest));
    }
  }
  reader.skip(static_cast<std::size_t>(reader.count("length of the description", 0)));

  // in floating point, because the product of damaged numbers may exceed all integers
  const double plane = 3.0 * grid.points[0] * grid.points[1];
  const double expected = 2.0 * grid.planes * (plane + 3.0 * tower);
  if (expected != static_cast<double>(reader.left())) {
    reader.fail(fmt::format("must hold {:.0f} bytes of velocities by its header, got {}", expected,
                            reader.left()));
  }
  const auto per_plane = static_cast<std::size_t>(plane);
  grid.values.reserve(per_plane * static_cast<std::size_t>(grid.planes));
  for (int t = 0; t < grid.planes; ++t) {
    for (std::size_t i = 0; i < per_plane; ++i) {
      const double value = reader.take<std::int16_t>();
      grid.values.push_back(static_cast<float>((value - intercept[i % 3]) / slope[i % 3]));
    }
    reader.skip(static_cast<std::size_t>(tower) * 3 * sizeof(std::int16_t));
  }
  return grid;
}

}  // namespace culm::flow
