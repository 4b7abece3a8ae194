#include "base64.hpp"
#include "names.hpp"
#include "vtu_grid.hpp"

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace culm::output {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

// Payload of VTK: the number of bytes as 64-bit integer, then the bytes, in one base64 text.
template <class T>
std::string payload(const std::vector<T>& values) {
  const std::span<const std::byte> data = std::as_bytes(std::span(values));
  const std::uint64_t size = data.size();
  std::vector<std::byte> bytes(sizeof size + data.size());
  std::memcpy(bytes.data(), &size, sizeof size);
  if (!data.empty()) std::memcpy(bytes.data() + sizeof size, data.data(), data.size());
  return base64(bytes);
}

template <class T>
std::string data_array(const char* type, const std::string& attributes,
                       const std::vector<T>& values) {
  return fmt::format("<DataArray type=\"{}\" {} format=\"binary\">{}</DataArray>\n", type,
                     attributes, payload(values));
}

std::string data_array(const VtuArray& array) {
  std::string attributes = fmt::format(R"(Name="{}")", xml_escape(array.name));
  if (array.columns > 1) attributes += fmt::format(R"( NumberOfComponents="{}")", array.columns);
  for (std::size_t c = 0; c < array.column_names.size(); ++c) {
    attributes += fmt::format(R"( ComponentName{}="{}")", c, xml_escape(array.column_names[c]));
  }
  return data_array("Float64", attributes, array.values);
}

// Numbers of structures under their names: of texts in a grid, other readers than those of VTK
// know nothing.
std::string numbers_of(const std::vector<std::string>& names) {
  std::string arrays;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string attributes =
        fmt::format(R"(Name="structure {}" NumberOfTuples="1")", xml_escape(names[i]));
    arrays += data_array("Int32", attributes, std::vector{static_cast<int>(i)});
  }
  return arrays;
}

std::string cells_text(const VtuGrid& grid) {
  const std::vector<std::uint8_t> types(grid.types.begin(), grid.types.end());
  return "<Cells>\n" + data_array("Int32", R"(Name="connectivity")", grid.connectivity) +
         data_array("Int32", R"(Name="offsets")", grid.offsets) +
         data_array("UInt8", R"(Name="types")", types) + "</Cells>\n";
}

}  // namespace

std::string vtu_text(const VtuGrid& grid, double time, const std::vector<std::string>& names) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n";
  text += data_array("Float64", R"(Name="TimeValue" NumberOfTuples="1")", std::vector{time});
  text += numbers_of(names);
  text += fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                      grid.points.size() / 3, grid.types.size());
  text += "<PointData>\n";
  for (const VtuArray& array : grid.point_data) text += data_array(array);
  text += "</PointData>\n<CellData>\n";
  text += data_array("Int32", R"(Name="structure")", grid.structures);
  for (const VtuArray& array : grid.cell_data) text += data_array(array);
  text += "</CellData>\n<Points>\n";
  text += data_array("Float64", R"(NumberOfComponents="3")", grid.points);
  text += "</Points>\n" + cells_text(grid);
  return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace culm::output
