/// A model of one beam element with a coupled section, for tests.
#pragma once

#include <culm/beam/element_batches.hpp>

#include "beam_case.hpp"

#include <culm_kit/batch_laws.hpp>

#include <array>
#include <cstddef>

namespace culm::beam {

inline kit::FillModel one_beam(const model::StrainDamping& damping) {
  return [damping](model::Model& model) {
    const auto slots = DirectorBeamCase<2>::reference();
    std::array<int, 3> nodes{};
    for (int a = 0; a < 3; ++a) {
      nodes[static_cast<std::size_t>(a)] = model.nodes().add(slots.middleCols<4>(4 * a));
    }
    model::elements<DirectorBeam<2>>(model, kit::effect, damping)
        .add(DirectorBeamCase<2>::make(), nodes);
  };
}

}  // namespace culm::beam
