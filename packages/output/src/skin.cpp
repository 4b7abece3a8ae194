#include <culm/math/types.hpp>
#include <culm/output/skin.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace culm::output {

namespace {

// How many lines begin or end at each node: one means that a line ends in the open there.
std::vector<int> count_line_ends(const StructureMesh& mesh) {
  std::vector<int> count(mesh.positions.size(), 0);
  for (const Cell& cell : mesh.cells) {
    if (cell.type != CellType::line) continue;
    ++count[index(cell.nodes.front())];
    ++count[index(cell.nodes.back())];
  }
  return count;
}

}  // namespace

Skin::Skin(const StructureMesh& mesh) : outlines_(mesh.outlines) {
  if (outlines_.empty()) return;
  first_point_.assign(mesh.positions.size(), 0);
  std::vector<bool> skinned(outlines_.size(), false);
  for (const Cell& cell : mesh.cells) {
    if (!has_outlines(cell)) continue;
    for (const int node : cell.nodes) skinned[index(node)] = true;
  }
  int points = 0;
  for (std::size_t node = 0; node < outlines_.size(); ++node) {
    if (!skinned[node]) outlines_[node].clear();
    first_point_[node] = points;
    points += static_cast<int>(outlines_[node].size());
  }
  const std::vector<int> line_ends = count_line_ends(mesh);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Cell& cell = mesh.cells[index(c)];
    if (!has_outlines(cell)) continue;
    add_sides(cell, c);
    if (line_ends[index(cell.nodes.front())] == 1) add_cap(cell.nodes.front(), c, true);
    if (line_ends[index(cell.nodes.back())] == 1) add_cap(cell.nodes.back(), c, false);
  }
}

bool Skin::has_outlines(const Cell& line) const {
  const std::size_t corners = outlines_[index(line.nodes.front())].size();
  return line.type == CellType::line && corners >= 3 &&
         std::all_of(line.nodes.begin(), line.nodes.end(),
                     [&](int node) { return outlines_[index(node)].size() == corners; });
}

void Skin::add_sides(const Cell& line, int cell) {
  for (std::size_t k = 0; k + 1 < line.nodes.size(); ++k) {
    const std::size_t here = index(line.nodes[k]);
    const std::size_t there = index(line.nodes[k + 1]);
    const int count = static_cast<int>(outlines_[here].size());
    const int a = first_point_[here];
    const int b = first_point_[there];
    for (int j = 0; j < count; ++j) {
      const int next = (j + 1) % count;
      // Outward normal if the line runs along d3.
      faces_.push_back({.points = {a + j, a + next, b + next, b + j}, .cell = cell});
    }
  }
}

void Skin::add_cap(int node, int cell, bool at_start) {
  std::vector<int> polygon(outlines_[index(node)].size());
  std::iota(polygon.begin(), polygon.end(), first_point_[index(node)]);
  if (at_start) std::reverse(polygon.begin(), polygon.end());
  faces_.push_back({.points = std::move(polygon), .cell = cell});
}

std::vector<Vec3> Skin::points(const std::vector<Vec3>& positions,
                               const std::vector<Mat3>& triads) const {
  std::vector<Vec3> points;
  for (std::size_t node = 0; node < outlines_.size(); ++node) {
    for (const Eigen::Vector2d& xi : outlines_[node]) {
      points.emplace_back(positions[node] + triads[node].leftCols<2>() * xi);
    }
  }
  return points;
}

}  // namespace culm::output
