#include <culm/joint/simple_support_local.hpp>

#include "supports.hpp"

namespace culm::joint {

model::Constraint simple_support_local(const Anchor& anchor, const Vec3& n,
                                       const Prescribed& motion) {
  model::Constraint support = support_of(anchor);
  support.rows = {
      model::product_row(anchor.vector(n), anchor.point(), anchor.reference(), anchor.position())};
  if (motion.moves()) drive_constant(motion, support);
  return support;
}

void register_simple_support_local(model::BuilderRegistry& registry) {
  const std::string type = "Simple Support Local";
  Schema schema = directed_schema(type, "Holds a node in one direction that turns with it.",
                                  "Direction", "Direction in the reference, of any length.");
  add_motion("Translation", "m", "Motion along the direction at function value 1.", schema);
  registry.add(type, schema, [type](const Options& options, model::BuildContext& context) {
    const auto motion = read_motion(options, "Translation", context);
    if (!motion) return;
    add_per_anchor(type, options, context, Holds::triads, [&](const Anchor& anchor) {
      return simple_support_local(anchor, read_direction(options, "Direction"), *motion);
    });
  });
}

}  // namespace culm::joint
