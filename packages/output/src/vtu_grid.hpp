/// An unstructured grid of VTK in memory, and its XML form.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace culm::output {

/// One number or vector per point or cell, made when it is written: a grid has one array at a time
/// in memory.
struct VtuArray {
  std::string name;
  int columns = 1;
  std::function<std::vector<double>()> values;  ///< row after row
  std::vector<std::string> column_names = {};
};

struct VtuGrid {
  std::vector<double> points;  ///< shape (3 points)
  std::vector<int> connectivity;
  std::vector<int> offsets;     ///< end of each cell in connectivity
  std::vector<int> types;       ///< VTK cell types
  std::vector<int> structures;  ///< per cell the number of its structure
  std::vector<VtuArray> point_data;
  std::vector<VtuArray> cell_data;
};

/// All grids as one. Data that a grid lacks is NaN there.
VtuGrid merge(std::vector<VtuGrid> grids);

/// Writes a .vtu file, numbers in base64. Throws FileError.
/// @param time   s
/// @param names  of all structures, in the order of their numbers
void write_vtu(const std::filesystem::path& path, const VtuGrid& grid, double time,
               const std::vector<std::string>& names);

}  // namespace culm::output
