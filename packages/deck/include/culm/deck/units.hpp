#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culm::deck {

/// A unit of measurement: its size in SI units and its dimension. Angles count as a dimension of
/// their own, so that a frequency in Hz is not taken for an angular velocity in rad/s.
struct Unit {
  /// Powers of length, mass, time, temperature and angle.
  std::array<int, 5> powers{};
  /// The size in SI units is numerator / denominator; two numbers, because 3 mm is 3 / 1000 m to
  /// the last digit, and 3 * 0.001 is not always.
  double numerator = 1.0;
  double denominator = 1.0;

  double to_si(double value) const { return value * numerator / denominator; }
  bool same_dimension(const Unit& other) const { return powers == other.powers; }
};

/// Reads a unit: names, products ("N m", "N*m"), quotients, whole powers and parentheses, such as
/// "kg/m^3", "m/s^2", "J/(kg K)". Empty if the text is none.
std::optional<Unit> find_unit(std::string_view text);

/// The names that find_unit knows.
std::vector<std::string> unit_names();

}  // namespace culm::deck
