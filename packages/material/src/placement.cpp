#include <culm/material/placement.hpp>

namespace culm::material {

Schema placement_schema() {
  Schema schema("Placement", "Where the section sits on the axis of the beam.");
  schema
      .add(numbers("Offset", "m",
                   "Position of the section's own origin along d1 and d2, from the beam axis.")
               .size(2)
               .optional({0.0, 0.0}))
      .add(number("Angle", "rad",
                  "Turns the section's own axes against d1, d2; positive from d1 to d2.")
               .optional(0.0));
  return schema;
}

Section place(const Section& section, const Options& options) {
  const auto& offset = options.numbers("Offset");
  return placed(section, options.number("Angle"), Vec<2>(offset[0], offset[1]));
}

}  // namespace culm::material
