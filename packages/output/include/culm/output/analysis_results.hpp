/// What an analysis leaves beside the states: tables, and shapes to look at.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace culm::output {

/// Rows of numbers under named columns.
struct NamedTable {
  std::string name;
  std::vector<std::string> columns;  ///< names with units
  std::vector<std::vector<double>> rows;
  std::vector<std::string> remarks;  ///< one per row, or none at all
};

/// Shapes at the nodes of one structure: displacement and rotation of each.
struct StructureShapes {
  std::string structure;
  std::size_t shapes = 0;
  std::size_t nodes = 0;
  std::vector<double> real;       ///< shape (shapes, nodes, 6)
  std::vector<double> imaginary;  ///< the same, or empty
};

/// A sparse matrix by its entries.
struct SparseMatrix {
  std::string name;
  int rows = 0;
  int columns = 0;
  std::vector<int> row;  ///< of each entry, from 0
  std::vector<int> column;
  std::vector<double> value;
};

/// All of one analysis.
struct AnalysisResults {
  std::string name;
  std::vector<NamedTable> tables;
  std::vector<std::string> shape_names;
  std::vector<StructureShapes> shapes;
  std::vector<SparseMatrix> matrices;
  int state = 0;  ///< number of the last recorded state before it, about which the shapes are
};

/// Writes a table as text: a line of names, then one per row; numbers have 17 digits and read back
/// exactly, the cell of one that is `absent` is empty; remarks are quoted. Throws FileError.
void write_csv(const std::filesystem::path& path, const NamedTable& table);

/// Writes a matrix in MatrixMarket's coordinate format, numbers as in write_csv. Throws FileError.
void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix);

}  // namespace culm::output
