/// Sections as bundles of fibres.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/math/types.hpp>

#include <array>
#include <string>
#include <vector>

namespace culm::material {

/// A fibre along a beam.
struct Fibre {
  Vec<2> place;  ///< (xi1, xi2) [m]
  double area;   ///< [m^2]
};

/// How many cells along two directions of a section.
using Cells = std::array<int, 2>;

/// How a section is cut in fibres: where it is the same, those of two sections belong to each other
/// one by one.
struct FibrePattern {
  std::string shape;  ///< type of the section; empty without fibres
  Cells cells = {};
  bool operator==(const FibrePattern&) const = default;
};

/// Fibres of a rectangle with corners `from` < `to`: 2 x 2 Gauss points in each cell, so that the
/// area and its moments up to the third are exact.
std::vector<Fibre> rectangle_fibres(const Vec<2>& from, const Vec<2>& to, const Cells& cells);
/// Fibres of a ring: cells.front() directions around, two Gauss points in each of cells.back()
/// cells across; area and second moments are exact from three directions on.
std::vector<Fibre> ring_fibres(double inner_radius, double outer_radius, const Cells& cells);

/// List "Plasticity" of sections with a shape, with `Cells` of it.
Schema fibre_schema();
/// An issue where a ring has too few cells around.
void check_cells_around(const Options& section, InputIssues& issues);
/// Whether the list is there.
bool yields(const Options& section);
/// The cells it asks for, or as many as are good for a shape. @pre yields(section)
Cells cells_of(const Options& section, const Cells& good);

}  // namespace culm::material
