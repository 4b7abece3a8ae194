#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/output/recorded_shape.hpp>

#include "hdf5_read.hpp"
#include "names.hpp"
#include "survive_reading.hpp"

#include <fmt/core.h>

namespace culm::output {
namespace {

std::string known_analyses(const Hdf5File& file) {
  if (!has_link(file, file.id(), "analyses")) return "none";
  return join(list_links(file, open_group(file, file.id(), "analyses").id()), ", ");
}

// The results of an analysis carry the checksum with which they were written.
void check_sum(const Hdf5File& file, const std::string& analysis) {
  if (read_int(file, file.id(), "format_version") < 4) return;  // their sums were others
  const Handle all = open_group(file, file.id(), "analyses");
  const std::string name = link_name(analysis);
  const Handle group = open_group(file, all.id(), name);
  if (read_text(file, group.id(), sum_attribute) == sum_text(sum_of_group(file, all.id(), name))) {
    return;
  }
  throw FileError(
      file.path().string(),
      fmt::format("is damaged: the results of '{}' are not what was written", analysis));
}

RecordedShape read_shape_of(const std::filesystem::path& path, const std::string& analysis,
                            int number) {
  const QuietHdf5 quiet;
  const Hdf5File file = Hdf5File::open(path);
  const std::string name = link_name(analysis);
  const bool has_analyses = has_link(file, file.id(), "analyses");
  const std::string place = "analyses/" + name;
  if (!has_analyses || !has_link(file, file.id(), place) ||
      !has_link(file, file.id(), place + "/shapes")) {
    throw FileError(file.path().string(), fmt::format("has no analysis '{}' with shapes; it has {}",
                                                      analysis, known_analyses(file)));
  }
  check_sum(file, analysis);
  const Handle group = open_group(file, file.id(), place + "/shapes");
  RecordedShape found;
  for (const std::string& link : list_links(file, group.id())) {
    const Shape size = read_shape(file, group.id(), link);
    if (number < 1 || static_cast<hsize_t>(number) > size[0]) {
      throw FileError(file.path().string(), fmt::format("analysis '{}' has shapes 1 to {}, not {}",
                                                        analysis, size[0], number));
    }
    const std::vector<double> all = read_doubles(file, group.id(), link);
    const std::size_t count = size[1] * size[2];
    const auto first = all.begin() + static_cast<std::ptrdiff_t>((number - 1) * count);
    const Handle mesh = open_group(file, file.id(), "mesh/" + link);
    found[read_text(file, mesh.id(), "name")] = {first, first + static_cast<std::ptrdiff_t>(count)};
  }
  return found;
}

}  // namespace

RecordedShape find_recorded_shape(const std::filesystem::path& path, const std::string& analysis,
                                  int number) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(path, ignored);
  const std::filesystem::path file = is_folder ? path / "run.h5" : path;
  survive_reading(file, [&] { read_shape_of(file, analysis, number); });
  return read_shape_of(file, analysis, number);
}

}  // namespace culm::output
