#include "mann_files.hpp"

#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace culm::flow {
namespace {

// files are little endian, and are copied as they are
static_assert(std::endian::native == std::endian::little);

std::vector<float> read_component(const std::string& name, const Where& where, double count) {
  const std::string path = (std::filesystem::path(where.file).parent_path() / name).string();
  const std::string bytes = read_file(path, where);
  // in floating point, because the product of mistaken numbers may exceed all integers
  if (static_cast<double>(bytes.size()) != count * sizeof(float)) {
    throw InputError({path, 0, {}},
                     fmt::format("must hold {:.0f} bytes by the 'Points' of the deck, got {}",
                                 count * sizeof(float), bytes.size()));
  }
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw InputError({path, 0, {}},
                     fmt::format("value {} of {} is no finite number", i, values.size()));
  }
  return values;
}

}  // namespace

TurbulenceGrid read_mann(const std::vector<std::string>& names, const Where& where,
                         const std::array<int, 3>& points, const std::array<double, 3>& spacing,
                         double speed) {
  TurbulenceGrid grid;
  grid.planes = points[0];
  grid.points = {points[1], points[2]};
  grid.spacing = {spacing[1], spacing[2]};
  grid.interval = spacing[0] / speed;
  grid.speed = speed;
  grid.periodic = true;
  const double count = 1.0 * points[0] * points[1] * points[2];
  const auto planes = static_cast<std::size_t>(points[0]);
  const auto across = static_cast<std::size_t>(points[1]);
  const auto upwards = static_cast<std::size_t>(points[2]);
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::vector<float> values = read_component(names[c], where, count);
    grid.values.resize(names.size() * values.size());
    auto value = values.begin();
    for (std::size_t x = 0; x < planes; ++x)
      for (std::size_t y = across; y-- > 0;)
        for (std::size_t z = 0; z < upwards; ++z) {
          grid.values[names.size() * ((x * upwards + z) * across + y) + c] = *value++;
        }
  }
  return grid;
}

}  // namespace culm::flow
