/// Named groups of nodes and elements, and the material points they give out.
#pragma once

#include <culm/math/types.hpp>
#include <culm/model/cells.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace culm::model {

class LayerSource;

/// A material point: a constant linear map from node coordinates to its position and directors,
///   x = sum_a N_a (x_a + sum_k offset_k d_k,a),   d_k = sum_a N_a d_k,a.   @source formulation 3.7
struct Marker {
  std::vector<int> nodes;
  std::vector<double> weights;  ///< N_a, same length as nodes, sum 1
  Vec3 offset = Vec3::Zero();   ///< in the directors of the nodes [m]
};

/// A marker at a node.
inline Marker marker_at(int node) { return {{node}, {1.0}, Vec3::Zero()}; }

/// A marker with its share of the length of a line.
struct LinePoint {
  Marker marker;
  double length = 0.0;  ///< quadrature weight [m]
};

/// The quadrature points of a line, element after element. Every process knows those of long lines,
/// so that what many of them share is kept once.
class LinePoints {
 public:
  LinePoints() = default;
  LinePoints(std::initializer_list<LinePoint> points) {
    for (const LinePoint& point : points) push_back(point);
  }

  /// @pre at no offset, on as many nodes as those before, and as many in a row on the same nodes as
  /// in the first element
  void push_back(const LinePoint& point);
  /// Room for so many.
  void reserve(std::size_t points);
  std::size_t size() const { return lengths_.size(); }
  bool empty() const { return lengths_.empty(); }
  LinePoint operator[](std::size_t i) const;
  double length(std::size_t i) const { return lengths_[i]; }
  /// Length of all.
  double length() const;
  /// Copies of some that follow each other.
  std::vector<LinePoint> copy(std::size_t first, std::size_t count) const;
  std::vector<LinePoint> copy() const { return copy(0, size()); }

 private:
  Cells elements_;
  CellNodes last_nodes_;
  std::size_t per_element_ = 0;               // points; not known within the first
  std::vector<std::vector<double>> weights_;  // all that occur
  std::vector<std::uint8_t> weights_of_;      // of each point, among them
  std::vector<double> lengths_;
};

/// A patch of surface with its nodes counter-clockwise seen from its upper side, for loads per
/// area: x = sum_a N_a (x_a + zeta d_a) with bilinear N_a.
struct Face {
  std::array<int, 4> nodes;
  double thickness = 0.0;  ///< zeta from -thickness / 2 to thickness / 2 [m]
};

/// Which nodes and cells of a refined structure the numbers of a deck mean: those of the mesh as
/// the deck describes it. Empty for structures that are not refined.
struct DeckNumbers {
  std::vector<int> nodes;               ///< node number in the model by number in the deck
  std::vector<std::vector<int>> cells;  ///< cells that a cell of the deck was divided into
};

/// A named part of the model.
struct Structure {
  std::string name;
  std::vector<int> nodes;                        ///< node numbers in the model, in order
  std::map<std::string, std::vector<int>> sets;  ///< named node sets: first, last, all, …
  Cells cells;
  LinePoints line_points;  ///< quadrature points for loads per length
  /// The same of its edges by name; an edge is also a node set.
  std::map<std::string, std::vector<LinePoint>> edges;
  std::vector<Face> faces;                        ///< for loads per area, one per cell of a shell
  std::shared_ptr<const LayerSource> layers;      ///< what happens within the wall of a shell
  std::map<std::string, std::vector<int>> parts;  ///< cells by name
  /// Outline of the cross-section at each node in (xi1, xi2) [m]; empty where there is none, and no
  /// entries where no node has one.
  std::vector<std::vector<Eigen::Vector2d>> outlines;
  DeckNumbers deck;
  /// The node that all others follow, where it is none of them: it has their mass.
  std::optional<int> body = {};

  /// Nodes in the order of their numbers in the deck.
  const std::vector<int>& numbered_nodes() const { return deck.nodes.empty() ? nodes : deck.nodes; }
  /// How many cells have a number in the deck.
  std::size_t numbered_cells() const {
    return deck.cells.empty() ? cells.size() : deck.cells.size();
  }
  /// The cells that a number of the deck means. @pre number < numbered_cells()
  std::vector<int> cells_of(int number) const;
};

/// The point of a line at a fraction of its length, 0 at the first node and 1 at the last. Within
/// an element the fraction is proportional to its natural coordinate. Nothing if it is no line.
std::optional<Marker> marker_at_fraction(const Structure& structure, double fraction);

}  // namespace culm::model
