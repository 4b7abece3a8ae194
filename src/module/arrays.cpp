#include "arrays.hpp"

#include <culm/base/error.hpp>

#include <algorithm>
#include <limits>
#include <string_view>

namespace culm::module {
namespace {

// An array as it comes. What lies under a mask was hidden on purpose, and numpy would take it.
py::array array_of(const py::object& given, const std::string& what) {
  // only what has a mask is looked at by numpy.ma, which takes longer than all else here
  if (py::hasattr(given, "_mask") &&
      py::module_::import("numpy.ma").attr("is_masked")(given).cast<bool>()) {
    throw UsageError(what + " has masked values: say what stands there, as with filled(0.0)");
  }
  py::array array = py::array::ensure(given);
  if (!array) throw UsageError(what + " must be an array of numbers");
  return array;
}

}  // namespace

py::array copy(std::span<const double> coordinates) {
  const auto nodes = static_cast<py::ssize_t>(coordinates.size() / 12);
  return py::array_t<double>({nodes, py::ssize_t{4}, py::ssize_t{3}}, coordinates.data());
}

std::string shape_of(const py::array& values) {
  return py::str(py::object(values.attr("shape"))).cast<std::string>();
}

Values numbers_of(const py::object& given, const std::string& what) {
  const py::array array = array_of(given, what);
  const bool is_real = std::string_view("biufO").find(array.dtype().kind()) != std::string::npos;
  Values numbers = is_real ? Values::ensure(array) : Values();
  if (!is_real || !numbers) {
    const std::string type = py::str(py::object(array.dtype())).cast<std::string>();
    throw UsageError(what + " must be an array of real numbers, and is one of " + type);
  }
  return numbers;
}

bool stand_in_order(const py::array& values, py::ssize_t items) {
  const auto proper = [](std::vector<py::ssize_t> shape) {
    std::erase(shape, 1);
    return shape;
  };
  const auto shape = proper({values.shape(), values.shape() + values.ndim()});
  return shape.size() < 2 || shape == proper({items, 6}) || shape == proper({items, 2, 3});
}

py::array rows_of(const std::vector<double>& values, int points) {
  const auto rows = static_cast<py::ssize_t>(points);
  const auto columns = static_cast<py::ssize_t>(values.size()) / rows;
  if (columns == 9)
    return py::array_t<double>({rows, py::ssize_t{3}, py::ssize_t{3}}, values.data());
  return py::array_t<double>({rows, columns}, values.data());
}

std::span<const double> three_columns(const Values& values, const std::string& what,
                                      std::optional<int> rows) {
  const bool has_rows = values.ndim() == 2 && (!rows || values.shape(0) == *rows);
  if (!has_rows || values.shape(1) != 3) {
    throw UsageError(what + " must have the shape (" + (rows ? std::to_string(*rows) : "points") +
                     ", 3), and has " + shape_of(values));
  }
  return {values.data(), static_cast<std::size_t>(values.size())};
}

Whole whole_numbers_of(const py::object& given, const std::string& what) {
  const py::array array = array_of(given, what);
  const Whole numbers = Whole::ensure(array);
  const py::module_ numpy = py::module_::import("numpy");
  if (!numbers || !numpy.attr("array_equal")(array, numbers).cast<bool>()) {
    throw UsageError(what + " must be whole numbers");
  }
  return numbers;
}

std::vector<port::Face> faces_of(const Whole& corners) {
  if (corners.ndim() != 2 || (corners.shape(1) != 3 && corners.shape(1) != 4)) {
    throw UsageError("faces must have the shape (faces, 3) or (faces, 4), and has " +
                     shape_of(corners));
  }
  constexpr long long most = std::numeric_limits<int>::max();
  std::vector<port::Face> faces;
  for (py::ssize_t i = 0; i < corners.shape(0); ++i) {
    port::Face& face = faces.emplace_back();
    face[3] = -1;
    for (py::ssize_t a = 0; a < corners.shape(1); ++a) {
      face[static_cast<std::size_t>(a)] =
          static_cast<int>(std::clamp(corners.at(i, a), -most, most));
    }
  }
  return faces;
}

}  // namespace culm::module
