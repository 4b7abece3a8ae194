/// What the output writers are given: plain data of a model.
#pragma once

#include <culm/base/cell_nodes.hpp>
#include <culm/math/types.hpp>

#include <Eigen/Core>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace culm::output {

/// How the nodes of a cell are joined.
enum class CellType {
  vertex,  ///< one node: rigid body, point mass
  line,    ///< two to four nodes in their order along the line: beam element
  quad4    ///< four nodes in circular order: shell element
};

/// One element as a picture shows it.
struct Cell {
  CellType type = CellType::vertex;
  CellNodes nodes;  ///< numbers within the structure, from 0
};

/// The directors that the nodes of a structure carry.
enum class Directors {
  none,    ///< positions only; triads are not read and may be left empty
  single,  ///< one director, through the thickness: the third column of each triad
  triad    ///< d1, d2, d3: the columns of each triad
};

/// A quantity at the nodes besides motion, such as reactions.
struct NodeArray {
  std::string name;
  int columns = 1;  ///< numbers per node
};

/// Numbers of the cells besides stress resultants, such as stresses of a layer.
struct CellArray {
  std::string name;
  std::vector<std::string> columns;  ///< one name per number of a cell
};

/// The nodes of a structure that a support, a joint or a connection acts on.
struct HeldNodes {
  std::string name;        ///< of the constraint, in the deck
  std::string type;        ///< "Rigid Support"
  std::vector<int> nodes;  ///< within the structure, from 0
};

/// The nodes of a structure that a load acts on.
struct LoadedNodes {
  std::string name;           ///< of the load, in the deck
  std::string type;           ///< "Force"
  std::vector<int> nodes;     ///< within the structure, from 0
  std::vector<Vec6> actions;  ///< force [N] and moment [N m] on each
};

/// One structure in the reference configuration.
struct StructureMesh {
  std::string name;                ///< unique in the model
  std::string type = "structure";  ///< what it is ("Beam"); each type gets its own picture files
  Directors directors = Directors::triad;
  std::vector<Vec3> positions;  ///< per node; m
  std::vector<Mat3> triads;     ///< per node, columns d1, d2, d3
  std::vector<Cell> cells;
  /// Per node the polygon around its cross-section, points (ξ1, ξ2) [m] counter-clockwise, without
  /// repeating the first; the same number of points along a line. Empty, or empty for a node: no
  /// skin.
  std::vector<std::vector<Eigen::Vector2d>> outlines;
  /// Names of the stress resultants of a cell. Three that follow each other and end in 1, 2, 3 (N1,
  /// N2, N3) are also shown as the vector N.
  std::vector<std::string> resultant_names;
  std::vector<NodeArray> node_arrays;
  std::vector<CellArray> cell_arrays;
  std::vector<HeldNodes> held;
  std::vector<LoadedNodes> loaded;  ///< of a model that is shown before it is solved

  int node_count() const { return static_cast<int>(positions.size()); }
  int cell_count() const { return static_cast<int>(cells.size()); }
};

/// One structure at one time; sizes as in its mesh.
struct StructureState {
  std::vector<Vec3> positions;     ///< per node; m
  std::vector<Mat3> triads;        ///< per node, columns d1, d2, d3
  std::vector<double> resultants;  ///< cell after cell, each as resultant_names
  /// Per NodeArray all its numbers, node after node; shape (nodes * columns).
  std::vector<std::vector<double>> node_values;
  /// Per CellArray all its numbers, cell after cell; shape (cells * columns).
  std::vector<std::vector<double>> cell_values = {};
  /// Per node the stress-free geometry that displacements start from; empty: that of the mesh.
  std::vector<Vec3> reference_positions = {};
  std::vector<Mat3> reference_triads = {};
};

/// A named table of numbers that belongs to no node or cell.
struct NamedArray {
  std::string name;
  int columns = 1;
  std::vector<double> values;  ///< row after row; shape (rows * columns)
};

/// The whole model at one time.
struct Picture {
  int index = 0;                           ///< number of the recorded step, from 0; increasing
  double time = 0.0;                       ///< s
  int analysis = 0;                        ///< number in the deck, from 0
  int step = 0;                            ///< of the analysis, from 1; 0 is its start
  std::vector<StructureState> structures;  ///< in the order of the meshes
  std::vector<NamedArray> arrays;          ///< further numbers of this step, kept in HDF5 only
};

/// One column of the history table.
struct HistoryColumn {
  std::string name;
  std::string unit;
};

/// One row of the history table.
struct HistoryRow {
  double time = 0.0;               ///< [s], or level
  std::span<const double> values;  ///< one per column
  int analysis = 0;                ///< number in the deck, from 0
  int step = 0;                    ///< of the analysis, from 1; 0 is its start
};

/// A number that a run reports at its end.
struct NamedScalar {
  std::string name;
  std::string unit;
  double value = 0.0;
};

/// Throws InternalError if a mesh contradicts itself or two meshes share a name.
void check_meshes(const std::vector<StructureMesh>& meshes);

/// Throws InternalError if the sizes of a picture are not those of the meshes.
void check_picture(const std::vector<StructureMesh>& meshes, const Picture& picture);

/// Where displacements of a state start from [m].
const std::vector<Vec3>& reference_of(const StructureMesh& mesh, const StructureState& state);

/// Numbers of the directors that are written, of 1, 2, 3.
std::vector<int> director_numbers(Directors directors);

}  // namespace culm::output
