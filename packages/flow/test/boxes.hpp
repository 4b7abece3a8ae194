/// Boxes of turbulence made of small files, for tests: 4 x 3 x 2 points about a hub at 90 m.
#pragma once

#include "flow_kit.hpp"

#include <cstring>
#include <functional>
#include <string>

namespace culm::flow {

/// Along the wind, across and upwards; planes pass by at the speed.
constexpr int nx = 4, ny = 3, nz = 2;
constexpr double dx = 4.0, dy = 10.0, dz = 20.0, speed = 8.0, dt = dx / speed;
constexpr double height = 90.0;

/// Place of a point of the grid, y from the right, in the plane of the centre.
inline Vec3 point(int z, int y) { return {0.0, -dy + dy * y, height - 0.5 * dz + dz * z}; }

/// The integer that a file has there: a number of its own for each value.
inline int written(int t, int z, int y, int c) { return 700 * t - 150 * z + 40 * y + 7 * c - 900; }

template <class Number>
void put(std::string& bytes, Number number) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &number, sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

/// Velocities are kept in single precision.
inline void expect_near(const Vec3& actual, const Vec3& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-5)
      << actual.transpose() << " : " << expected.transpose();
}

/// What an error says, or "none".
inline std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace culm::flow
