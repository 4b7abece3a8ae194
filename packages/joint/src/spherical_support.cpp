#include <culm/joint/spherical_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint spherical_support(const Anchor& anchor, const Vec3& offset,
                                    const Translation& motion) {
  model::Constraint support = support_of(anchor);
  add_vector_rows(anchor.point(offset), anchor, support);
  if (motion.moves()) {
    drive_constants(motion, support);
  } else if (is_node(anchor, offset)) {
    support.fix = {anchor.node(), {0b000111}};
  }
  return support;
}

void register_spherical_support(model::BuilderRegistry& registry) {
  const std::string type = "Spherical Support";
  Schema schema(type, "Holds a point, or moves it as prescribed, and leaves all rotations free.");
  schema.add(anchor_field()).add(offset_field());
  add_translation(schema);
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    const auto motion = read_translation(options, context);
    if (!motion) return;
    add_per_anchor(type, options, context, Holds::all, [&](const Anchor& anchor) {
      return spherical_support(anchor, model::vector(options, "Offset"), *motion);
    });
  });
}

}  // namespace culm::joint
