/// Arrays of numpy as they come and as they go.
#pragma once

#include <culm/port/faces.hpp>

#include <pybind11/numpy.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::module {

namespace py = pybind11;

using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Whole = py::array_t<long long, py::array::c_style | py::array::forcecast>;

// What comes: all throw UsageError that begins with `what` where it is nothing of the kind.

/// Its numbers, of any stride, order and type that is real, without a mask that hides some.
Values numbers_of(const py::object& given, const std::string& what);
/// The numbers of points, which a fraction would be cut down to.
Whole whole_numbers_of(const py::object& given, const std::string& what);
/// The numbers of an array with three columns, and with so many rows.
std::span<const double> three_columns(const Values& values, const std::string& what,
                                      std::optional<int> rows = {});
/// Faces of three or four points, an array with as many columns.
std::vector<port::Face> faces_of(const Whole& corners);

/// Whether values stand in the order of items: flat, or in a row for each item, which may be cut in
/// force and moment. Others, as those of a transposed array, are as many and mean something else.
bool stand_in_order(const py::array& values, py::ssize_t items);
/// A shape as Python writes it.
std::string shape_of(const py::array& values);

// What goes.

/// A copy of coordinates, x and the three directors of each node.
py::array copy(std::span<const double> coordinates);
/// Numbers of points as an array of one row per point.
py::array rows_of(const std::vector<double>& values, int points);

}  // namespace culm::module
