#include "mesh_tables.hpp"

namespace culm::output {

namespace {

void append(std::vector<double>& numbers, const Vec3& v) {
  numbers.insert(numbers.end(), v.data(), v.data() + 3);
}

int vtk_type(CellType type) {
  switch (type) {
    case CellType::vertex:
      return 1;
    case CellType::line:
      return 4;  // a polyline, because ours has its nodes in order
    case CellType::quad4:
      return 9;
  }
  return 0;
}

}  // namespace

std::vector<double> flatten(const std::vector<Vec3>& points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const Vec3& point : points) append(numbers, point);
  return numbers;
}

std::vector<double> flatten_director(const std::vector<Mat3>& triads, int number) {
  std::vector<double> numbers;
  numbers.reserve(3 * triads.size());
  for (const Mat3& triad : triads) append(numbers, triad.col(number - 1));
  return numbers;
}

std::vector<double> flatten_difference(const std::vector<Vec3>& state,
                                       const std::vector<Vec3>& reference) {
  std::vector<double> numbers;
  numbers.reserve(3 * state.size());
  for (std::size_t i = 0; i < state.size(); ++i) append(numbers, state[i] - reference[i]);
  return numbers;
}

std::vector<double> flatten_rows(const std::vector<std::vector<double>>& rows) {
  std::vector<double> numbers;
  for (const std::vector<double>& row : rows) numbers.insert(numbers.end(), row.begin(), row.end());
  return numbers;
}

CellTable cell_table(const std::vector<Cell>& cells) {
  CellTable table;
  for (const Cell& cell : cells) {
    table.connectivity.insert(table.connectivity.end(), cell.nodes.begin(), cell.nodes.end());
    table.offsets.push_back(static_cast<int>(table.connectivity.size()));
    table.types.push_back(vtk_type(cell.type));
  }
  return table;
}

OutlineTable outline_table(const std::vector<std::vector<Eigen::Vector2d>>& outlines) {
  OutlineTable table;
  const std::vector<Eigen::Vector2d>* last = nullptr;
  for (const std::vector<Eigen::Vector2d>& outline : outlines) {
    if (!outline.empty() && (last == nullptr || *last != outline)) {
      for (const Eigen::Vector2d& xi : outline) {
        table.points.insert(table.points.end(), {xi.x(), xi.y()});
      }
      table.ends.push_back(static_cast<int>(table.points.size() / 2));
      last = &outline;
    }
    table.of_node.push_back(outline.empty() ? -1 : static_cast<int>(table.ends.size()) - 1);
  }
  return table;
}

std::vector<int> xdmf_topology(const std::vector<Cell>& cells) {
  constexpr int polyvertex = 1, polyline = 2, quadrilateral = 5;
  std::vector<int> numbers;
  for (const Cell& cell : cells) {
    const int count = static_cast<int>(cell.nodes.size());
    switch (cell.type) {
      case CellType::vertex:
        numbers.insert(numbers.end(), {polyvertex, count});
        break;
      case CellType::line:
        numbers.insert(numbers.end(), {polyline, count});
        break;
      case CellType::quad4:
        numbers.push_back(quadrilateral);
        break;
    }
    numbers.insert(numbers.end(), cell.nodes.begin(), cell.nodes.end());
  }
  return numbers;
}

}  // namespace culm::output
