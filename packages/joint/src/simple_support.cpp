#include <culm/joint/simple_support.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint simple_support(const Anchor& anchor, const Vec3& n, const Vec3& offset,
                                 const Prescribed& motion) {
  model::Constraint support = support_of(anchor);
  support.rows = {model::linear_row(n, anchor.point(offset), anchor.reference())};
  if (motion.moves()) {
    drive_constant(motion, support);
  } else if (const auto axis = coordinate_axis(n); axis && is_node(anchor, offset)) {
    support.fix = {anchor.node(), std::bitset<6>().set(*axis)};
  }
  return support;
}

void register_simple_support(model::BuilderRegistry& registry) {
  const std::string type = "Simple Support";
  Schema schema = directed_schema(type, "Holds a point in one direction fixed in space.",
                                  "Direction", "Direction in space, of any length.");
  schema.add(offset_field());
  add_motion("Translation", "m", "Motion along the direction at function value 1.", schema);
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    const auto motion = read_motion(options, "Translation", context);
    if (!motion) return;
    add_per_anchor(type, options, context, Holds::all, [&](const Anchor& anchor) {
      return simple_support(anchor, read_direction(options, "Direction"),
                            model::vector(options, "Offset"), *motion);
    });
  });
}

}  // namespace culm::joint
