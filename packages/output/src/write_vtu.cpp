#include "base64.hpp"
#include "names.hpp"
#include "replace_file.hpp"
#include "vtu_grid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace culm::output {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

// Payload of VTK: the number of bytes as 64-bit integer, then the bytes, in one base64 text, which
// goes out in pieces of whole groups of three.
template <class T>
void write_payload(const Sink& sink, const std::vector<T>& values) {
  const std::span<const std::byte> data = std::as_bytes(std::span(values));
  const std::uint64_t size = data.size();
  std::array<std::byte, 3 * 16384> piece;
  std::memcpy(piece.data(), &size, sizeof size);
  std::size_t filled = sizeof size;
  for (std::size_t at = 0; at < data.size() || filled > 0; filled = 0) {
    const std::size_t count = std::min(piece.size() - filled, data.size() - at);
    if (count > 0) std::memcpy(piece.data() + filled, data.data() + at, count);
    at += count;
    sink(base64(std::span(piece).first(filled + count)));
  }
}

template <class T>
void write_array(const Sink& sink, const char* type, const std::string& attributes,
                 const std::vector<T>& values) {
  sink(fmt::format("<DataArray type=\"{}\" {} format=\"binary\">", type, attributes));
  write_payload(sink, values);
  sink("</DataArray>\n");
}

void write_array(const Sink& sink, const VtuArray& array) {
  std::string attributes = fmt::format(R"(Name="{}")", xml_escape(array.name));
  if (array.columns > 1) attributes += fmt::format(R"( NumberOfComponents="{}")", array.columns);
  for (std::size_t c = 0; c < array.column_names.size(); ++c) {
    attributes += fmt::format(R"( ComponentName{}="{}")", c, xml_escape(array.column_names[c]));
  }
  write_array(sink, "Float64", attributes, array.values());
}

// Numbers of structures under their names: of texts in a grid, other readers than those of VTK
// know nothing.
void write_numbers(const Sink& sink, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string attributes =
        fmt::format(R"(Name="structure {}" NumberOfTuples="1")", xml_escape(names[i]));
    write_array(sink, "Int32", attributes, std::vector{static_cast<int>(i)});
  }
}

void write_cells(const Sink& sink, const VtuGrid& grid) {
  const std::vector<std::uint8_t> types(grid.types.begin(), grid.types.end());
  sink("<Cells>\n");
  write_array(sink, "Int32", R"(Name="connectivity")", grid.connectivity);
  write_array(sink, "Int32", R"(Name="offsets")", grid.offsets);
  write_array(sink, "UInt8", R"(Name="types")", types);
  sink("</Cells>\n");
}

void write_grid(const Sink& sink, const VtuGrid& grid, double time,
                const std::vector<std::string>& names) {
  sink(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n");
  write_array(sink, "Float64", R"(Name="TimeValue" NumberOfTuples="1")", std::vector{time});
  write_numbers(sink, names);
  sink(fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                   grid.points.size() / 3, grid.types.size()));
  sink("<PointData>\n");
  for (const VtuArray& array : grid.point_data) write_array(sink, array);
  sink("</PointData>\n<CellData>\n");
  write_array(sink, "Int32", R"(Name="structure")", grid.structures);
  for (const VtuArray& array : grid.cell_data) write_array(sink, array);
  sink("</CellData>\n<Points>\n");
  write_array(sink, "Float64", R"(NumberOfComponents="3")", grid.points);
  sink("</Points>\n");
  write_cells(sink, grid);
  sink("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const VtuGrid& grid, double time,
               const std::vector<std::string>& names) {
  replace_file(path, [&](const Sink& sink) { write_grid(sink, grid, time, names); });
}

}  // namespace culm::output
