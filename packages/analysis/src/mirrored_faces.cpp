#include "mirrored_faces.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace culm::analysis {
namespace {

// The tangents at the centre and the sum of the directors, which in the reference form a
// right-handed system.
bool is_mirrored(const model::Face& face, const model::Coordinates& q) {
  const auto at = [&](std::size_t corner, int slot) {
    return Vec3(model::NodeTable::slots(q, face.nodes[corner]).col(slot));
  };
  const Vec3 first = at(1, 0) + at(2, 0) - at(0, 0) - at(3, 0);
  const Vec3 second = at(2, 0) + at(3, 0) - at(0, 0) - at(1, 0);
  const Vec3 director = at(0, 1) + at(1, 1) + at(2, 1) + at(3, 1);
  return first.cross(second).dot(director) < 0.0;
}

// Of the faces whose nodes this rank has; each face is on some rank.
bool has_mirrored_face(const assembly::System& system, const model::Coordinates& q) {
  const auto is_here = [&](const model::Face& face) {
    return std::ranges::all_of(face.nodes, [&](int node) { return system.needs(node); });
  };
  return std::ranges::any_of(system.model().structures(), [&](const model::Structure& structure) {
    return std::ranges::any_of(structure.faces, [&](const model::Face& face) {
      return is_here(face) && is_mirrored(face, q);
    });
  });
}

}  // namespace

void refuse_mirrored(Context& context, model::State& state, solver::StepOutcome& outcome) {
  const model::Model& model = context.system.model();
  const bool has_faces = std::ranges::any_of(
      model.structures(), [](const model::Structure& s) { return !s.faces.empty(); });
  if (!has_faces || !outcome.converged()) return;
  const bool is_found = has_mirrored_face(context.system, state.next);
  if (context.system.comm().max(is_found ? 1 : 0) != 0) {
    outcome.end = solver::StepEnd::out_of_range;
  }
}

}  // namespace culm::analysis
