/// A force and a moment of known components, for tests of loads.
#pragma once

#include <culm/load/moment_load.hpp>
#include <culm/load/slot_load.hpp>

#include <culm_kit/batch_laws.hpp>

#include <functional>
#include <memory>

namespace culm::load {

inline const Vec3 components(1.3, -2.1, 0.7);
/// Of the point of a force, in the directors of its node.
inline const Vec3 offset(0.2, -0.5, 0.3);

/// What a few operations on such numbers leave.
constexpr double round_off = 1e-14;

/// Makes a load on the first node.
using Make = std::function<std::unique_ptr<model::Batch>(const model::NodeTable& nodes,
                                                         const model::Amplitude& amplitude)>;

/// Off the node where that has a triad.
inline Make force_in(Axes axes) {
  return [=](const model::NodeTable& nodes, const model::Amplitude& amplitude) {
    auto load = std::make_unique<SlotLoad>(kit::effect, nodes, amplitude);
    model::Marker point = model::marker_at(0);
    if (nodes.kind(0) == NodeKind::node12) point.offset = offset;
    load->add_force(point, components, axes);
    return load;
  };
}

inline Make moment_in(Axes axes) {
  return [=](const model::NodeTable& nodes, const model::Amplitude& amplitude) {
    auto load = std::make_unique<MomentLoad>(kit::effect, nodes, amplitude, axes);
    load->add_moment(0, components);
    return load;
  };
}

}  // namespace culm::load
