#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/output/recorded_shape.hpp>

#include "hdf5_read.hpp"
#include "names.hpp"

#include <fmt/core.h>

namespace culm::output {
namespace {

std::string known_analyses(const Hdf5File& file) {
  if (!has_link(file, file.id(), "analyses")) return "none";
  return join(list_links(file, open_group(file, file.id(), "analyses").id()), ", ");
}

}  // namespace

RecordedShape find_recorded_shape(const std::filesystem::path& path, const std::string& analysis,
                                  int number) {
  const QuietHdf5 quiet;
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(path, ignored);
  const Hdf5File file = Hdf5File::open(is_folder ? path / "run.h5" : path);
  const std::string name = link_name(analysis);
  const bool has_analyses = has_link(file, file.id(), "analyses");
  const std::string place = "analyses/" + name;
  if (!has_analyses || !has_link(file, file.id(), place) ||
      !has_link(file, file.id(), place + "/shapes")) {
    throw FileError(file.path().string(), fmt::format("has no analysis '{}' with shapes; it has {}",
                                                      analysis, known_analyses(file)));
  }
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

}  // namespace culm::output
