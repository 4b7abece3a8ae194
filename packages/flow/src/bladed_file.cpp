#include "bladed_file.hpp"

#include <culm/base/read_file.hpp>

#include "binary_reader.hpp"

#include <algorithm>
#include <filesystem>

namespace culm::flow {
namespace {

constexpr std::int16_t mark = -99;
// of spectra; what follows in the header depends on it
constexpr int one_von_karman = 1;
constexpr int one_kaimal = 2;
constexpr int von_karman = 3;
constexpr int improved_von_karman = 4;
constexpr int iec_kaimal = 5;
constexpr int general_kaimal = 7;
constexpr int mann = 8;

struct Header {
  int components = 3;
  std::optional<std::array<double, 3>> intensities;
  TurbulenceGrid grid;
};

int read_components(BinaryReader& reader) {
  const int components = reader.count("number of components", 1);
  if (components > 3) reader.fail(fmt::format("has {} components; 1 to 3 are known", components));
  return components;
}

Header read_header(BinaryReader& reader, const std::optional<double>& speed) {
  const auto first = reader.take<std::int16_t>();
  if (first != mark) {
    reader.fail(fmt::format(
        "is no box of Bladed: it begins with {}, not with -99 (older files are not known)", first));
  }
  const int kind = reader.take<std::int16_t>();
  Header header;
  if (kind == one_von_karman || kind == one_kaimal) {
    header.components = 1;
  } else if (kind == improved_von_karman) {
    header.components = read_components(reader);
    reader.skip(3 * sizeof(float));  // latitude, roughness, height
    std::array<double, 3> intensities{};
    for (double& intensity : intensities) intensity = 0.01 * reader.finite("turbulence intensity");
    header.intensities = intensities;
  } else if (kind == general_kaimal || kind == mann) {
    reader.skip(sizeof(std::int32_t));  // size of the header
    header.components = read_components(reader);
  } else if (kind != von_karman && kind != iec_kaimal) {
    reader.fail(fmt::format("has a spectrum of kind {}; 1 to 5, 7 and 8 are known", kind));
  }
  TurbulenceGrid& grid = header.grid;
  grid.spacing[1] = reader.positive("spacing upwards");
  grid.spacing[0] = reader.positive("spacing across");
  const double along = reader.positive("spacing along");
  const int half = reader.count("half the number of planes", 1);
  const double own_speed = reader.positive("mean speed");
  reader.skip(3 * sizeof(float) + 2 * sizeof(std::int32_t));  // lengths of the spectrum, seed
  grid.points[1] = reader.count("number of points upwards", 2);
  grid.points[0] = reader.count("number of points across", 2);
  if (header.components == 3) reader.skip(6 * sizeof(float));
  if (kind == general_kaimal) reader.skip(2 * sizeof(float));
  if (kind == mann) reader.skip(16 * sizeof(float));
  grid.speed = speed.value_or(own_speed);
  grid.interval = along / grid.speed;
  const double plane =
      sizeof(std::int16_t) * 1.0 * header.components * grid.points[0] * grid.points[1];
  // half of an odd number is rounded down
  const double planes = static_cast<double>(reader.left()) / plane;
  if (planes != 2.0 * half && planes != 2.0 * half + 1.0) {
    reader.fail(fmt::format("must hold {:.0f} bytes of velocities by its header, got {}",
                            2.0 * half * plane, reader.left()));
  }
  grid.planes = static_cast<int>(planes);
  return header;
}

}  // namespace

TurbulenceGrid read_bladed(const std::string& name, const Where& where,
                           const BladedScaling& scaling) {
  const std::string path = (std::filesystem::path(where.file).parent_path() / name).string();
  const std::string bytes = read_file(path, where);
  BinaryReader reader(bytes, path);
  Header header = read_header(reader, scaling.speed);
  const auto intensities = scaling.intensities ? scaling.intensities : header.intensities;
  if (!intensities) {
    throw InputError(where, fmt::format("{} does not say its turbulence intensities; give "
                                        "'Intensities'",
                                        path));
  }
  TurbulenceGrid& grid = header.grid;
  grid.periodic = scaling.is_periodic;
  std::array<double, 3> factor{};
  for (std::size_t c = 0; c < 3; ++c) factor[c] = 1e-3 * (*intensities)[c] * grid.speed;
  if (scaling.is_left_handed) factor[1] = -factor[1];
  const double mean = scaling.contains_mean ? grid.speed : 0.0;
  const auto across = static_cast<std::size_t>(grid.points[0]);
  const auto rows =
      static_cast<std::size_t>(grid.planes) * static_cast<std::size_t>(grid.points[1]);
  const auto components = static_cast<std::size_t>(header.components);
  grid.values.assign(3 * across * rows, 0.0F);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < across; ++i) {
      const std::size_t y = scaling.begins_at_left ? across - 1 - i : i;
      float* point = &grid.values[3 * (row * across + y)];
      point[0] = static_cast<float>(mean);
      for (std::size_t c = 0; c < components; ++c) {
        point[c] += static_cast<float>(factor[c] * reader.take<std::int16_t>());
      }
    }
  }
  return std::move(header.grid);
}

}  // namespace culm::flow
