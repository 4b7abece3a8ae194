#include <culm/joint/revolute_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint revolute_support(const Anchor& anchor, const Vec3& axis, const Vec3& offset) {
  model::Constraint support = support_of(anchor);
  add_vector_rows(anchor.point(offset), anchor, support);
  if (anchor.on_shell()) {
    support.rows.push_back(model::linear_row(axis, anchor.director(), anchor.reference()));
  } else {
    add_axis_rows(axis, anchor, support);
  }
  if (const auto i = coordinate_axis(axis); i && is_node(anchor, offset)) {
    const std::bitset<6> held =
        anchor.on_shell() ? std::bitset<6>().set(3 + *i) : rotations_across(*i);
    support.fix = {anchor.node(), held | std::bitset<6>(0b000111)};
  }
  return support;
}

void register_revolute_support(model::BuilderRegistry& registry) {
  const std::string type = "Revolute Support";
  Schema schema = directed_schema(type, "Holds a point and leaves the rotation about one axis.",
                                  "Axis", "Axis that stays free, of any length.");
  schema.add(offset_field());
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    add_per_anchor(type, options, context, Holds::all, [&](const Anchor& anchor) {
      return revolute_support(anchor, read_direction(options, "Axis"),
                              model::vector(options, "Offset"));
    });
  });
}

}  // namespace culm::joint
