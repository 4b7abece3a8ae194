/// Many points or vectors, component by component.
#pragma once

#include <culm/math/types.hpp>

#include <cstddef>
#include <vector>

namespace culm::lattice {

/// Places [m], velocities [m/s] or forces [N] as one array per component, as the kernel reads them.
struct Points {
  std::vector<double> x, y, z;

  Points() = default;
  explicit Points(std::size_t count) { resize(count); }

  std::size_t size() const { return x.size(); }
  /// New ones are zero.
  void resize(std::size_t count) {
    x.resize(count);
    y.resize(count);
    z.resize(count);
  }
  void reserve(std::size_t count) {
    x.reserve(count);
    y.reserve(count);
    z.reserve(count);
  }
  void clear() { resize(0); }
  void assign_zero(std::size_t count) {
    x.assign(count, 0.0);
    y.assign(count, 0.0);
    z.assign(count, 0.0);
  }

  Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3& p) {
    x[i] = p.x();
    y[i] = p.y();
    z[i] = p.z();
  }
  void add(std::size_t i, const Vec3& p) {
    x[i] += p.x();
    y[i] += p.y();
    z[i] += p.z();
  }
  void push_back(const Vec3& p) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
};

}  // namespace culm::lattice
