#include <culm/joint/planar_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint planar_support(const Anchor& anchor, const Vec3& normal) {
  model::Constraint support = support_of(anchor);
  support.rows = {model::linear_row(normal, anchor.point(), anchor.reference())};
  if (anchor.on_shell()) {
    support.rows.push_back(model::linear_row(normal, anchor.director(), anchor.reference()));
  } else {
    add_axis_rows(normal, anchor, support);
  }
  if (const auto axis = coordinate_axis(normal); axis && is_node(anchor, Vec3::Zero())) {
    // of a director the component along the normal, of a triad the rotations across it
    const std::bitset<6> held =
        anchor.on_shell() ? std::bitset<6>().set(3 + *axis) : rotations_across(*axis);
    support.fix = {anchor.node(), std::bitset<6>(held).set(*axis)};
  }
  return support;
}

namespace {

void register_planar_type(model::BuilderRegistry& registry, const std::string& type,
                          const std::string& doc) {
  registry.add(type, directed_schema(type, doc, "Normal", "Normal of the plane, of any length."),
               [type](const Options& options, model::BuildContext& context) {
                 add_per_anchor(type, options, context, Holds::all, [&](const Anchor& anchor) {
                   return planar_support(anchor, read_direction(options, "Normal"));
                 });
               });
}

}  // namespace

void register_planar_support(model::BuilderRegistry& registry) {
  register_planar_type(registry, "Planar Support",
                       "Leaves motion in a plane and rotation about its normal.");
  register_planar_type(
      registry, "Symmetry",
      "Holds nodes in a plane of symmetry, with what lies beyond the plane left out.");
}

}  // namespace culm::joint
