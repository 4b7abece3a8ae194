#include <culm/base/error.hpp>
#include <culm/output/xdmf.hpp>

#include "hdf5_read.hpp"
#include "names.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

namespace culm::output {

namespace {

std::vector<int> find_directors(const Hdf5File& file, hid_t group) {
  std::vector<int> numbers;
  for (const int number : {1, 2, 3}) {
    if (has_link(file, group, "director" + std::to_string(number))) numbers.push_back(number);
  }
  return numbers;
}

std::vector<NodeArray> read_node_arrays(const Hdf5File& file, hid_t group) {
  const std::vector<std::string> names = read_texts(file, group, "node_array_names");
  const std::vector<int> columns = read_ints(file, group, "node_array_columns");
  if (columns.size() != names.size()) {
    throw FileError(file.path().string(), "node arrays need one number of columns each");
  }
  std::vector<NodeArray> arrays;
  for (std::size_t a = 0; a < names.size(); ++a) arrays.push_back({names[a], columns[a]});
  return arrays;
}

std::vector<CellArray> read_cell_arrays(const Hdf5File& file, hid_t group) {
  const std::vector<std::string> names = read_texts(file, group, "cell_array_names");
  const std::vector<std::string> columns = read_texts(file, group, "cell_array_columns");
  if (columns.size() != names.size()) {
    throw FileError(file.path().string(), "cell arrays need one list of columns each");
  }
  std::vector<CellArray> arrays;
  for (std::size_t a = 0; a < names.size(); ++a) {
    std::istringstream text(columns[a]);
    arrays.push_back({names[a], {std::istream_iterator<std::string>(text), {}}});
  }
  return arrays;
}

std::size_t read_length(const Hdf5File& file, hid_t group, const std::string& name) {
  const Shape shape = read_shape(file, group, name);
  if (shape.empty()) throw FileError(file.path().string(), "dataset " + name + " has no rows");
  return shape[0];
}

StructureFields read_structure(const Hdf5File& file, hid_t group) {
  return {.name = read_text(file, group, "name"),
          .type = read_text(file, group, "type"),
          .nodes = read_length(file, group, "position"),
          .cells = read_length(file, group, "cell_types"),
          .topology_size = static_cast<std::size_t>(read_int(file, group, "topology_size")),
          .directors = find_directors(file, group),
          .resultant_names = read_texts(file, group, "resultant_names"),
          .node_arrays = read_node_arrays(file, group),
          .cell_arrays = read_cell_arrays(file, group)};
}

std::vector<StructureFields> read_structures(const Hdf5File& file) {
  const Handle meshes = open_group(file, file.id(), "mesh");
  std::vector<std::pair<int, StructureFields>> numbered;
  for (const std::string& name : list_links(file, meshes.id())) {
    const Handle group = open_group(file, meshes.id(), name);
    numbered.emplace_back(read_int(file, group.id(), "number"), read_structure(file, group.id()));
  }
  std::sort(numbered.begin(), numbered.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<StructureFields> structures;
  for (auto& [number, structure] : numbered) structures.push_back(std::move(structure));
  return structures;
}

}  // namespace

std::filesystem::path write_xdmf_for(const std::filesystem::path& h5) {
  const QuietHdf5 quiet;
  const Hdf5File file = Hdf5File::open(h5);
  if (!has_link(file, file.id(), "mesh") || !has_link(file, file.id(), "steps")) {
    throw FileError(h5.string(), "is not a result file of culm");
  }
  const std::filesystem::path path = std::filesystem::path(h5).replace_extension(".xdmf");
  XdmfFile index(path, h5.filename().string(), read_structures(file));
  for (const Recorded::Step& step : read_steps(file)) index.add_step(step.index, step.time);
  index.write();
  return path;
}

}  // namespace culm::output
