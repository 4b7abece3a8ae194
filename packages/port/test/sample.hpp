/// Structures without elements, to attach ports to.
#pragma once

#include <culm/math/rotation.hpp>
#include <culm/model/model.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace culm::port {

/// Adds nodes along a line and joins them in cells of `order` + 1 nodes.
template <class Slots>
void add_line(model::Model& model, const std::string& name, int cells, int order, Slots slots_at) {
  model::Structure& line = model.add_structure(name);
  for (int i = 0; i <= cells * order; ++i) {
    line.nodes.push_back(model.nodes().add(slots_at(static_cast<double>(i) / (cells * order))));
  }
  for (int c = 0; c < cells; ++c) {
    const auto first = line.nodes.begin() + c * order;
    line.cells.push_back({{first, first + order + 1}, nullptr, 0});
  }
}

/// A line of length 10 along a helix, its triads twisted by one radian from end to end.
inline void add_helix(model::Model& model, int cells, int order,
                      const std::string& name = "helix") {
  add_line(model, name, cells, order, [](double s) {
    const double angle = 1.2 * s, radius = 8.0, climb = 2.0;
    const Vec3 tangent(-radius * std::sin(angle), radius * std::cos(angle), climb / 1.2);
    model::NodeSlots slots;
    slots.col(0) = Vec3(radius * std::cos(angle), radius * std::sin(angle), climb * s);
    const Mat3 triad = triad_along(tangent, Vec3::UnitZ());
    slots.rightCols<3>() = exp_rotation(s * triad.col(2)) * triad;
    return slots;
  });
}

/// A straight line of length 10 along x from a point, d1 = y, d2 = z.
inline void add_straight(model::Model& model, int cells, int order, const std::string& name,
                         const Vec3& from = Vec3::Zero()) {
  add_line(model, name, cells, order, [&](double s) {
    model::NodeSlots slots;
    slots << from + 10.0 * s * Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX();
    return slots;
  });
}

/// A part of a cylinder about y of radius 5 m, 3 x 2 faces, directors outwards.
inline void add_roof(model::Model& model, const std::string& name = "roof") {
  constexpr int across = 3, along = 2;
  model::Structure& roof = model.add_structure(name);
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i <= across; ++i) {
      const double angle = 0.3 * i;
      model::NodeSlots slots = model::NodeSlots::Zero();
      slots.col(1) = Vec3(std::sin(angle), 0.0, std::cos(angle));
      slots.col(0) = 5.0 * slots.col(1) + 2.0 * j * Vec3::UnitY();
      roof.nodes.push_back(model.nodes().add(slots, NodeKind::node6));
    }
  }
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < across; ++i) {
      const auto node = [&](int k, int l) {
        return roof.nodes[static_cast<std::size_t>((j + l) * (across + 1) + i + k)];
      };
      roof.cells.push_back({{node(0, 0), node(1, 0), node(1, 1), node(0, 1)}, nullptr, 0});
    }
  }
}

/// A body with a turned triad.
inline void add_ball(model::Model& model, const Vec3& at, const std::string& name = "ball") {
  model::NodeSlots slots;
  slots << at, exp_rotation(Vec3(0.4, -0.7, 0.2));
  const int node = model.nodes().add(slots);
  model::Structure& ball = model.add_structure(name);
  ball.nodes = {node};
  ball.cells.push_back({{node}, nullptr, 0});
}

}  // namespace culm::port
