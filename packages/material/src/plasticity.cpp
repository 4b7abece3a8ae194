#include <culm/material/plasticity.hpp>

namespace culm::material {

Schema plasticity_schema() {
  Schema schema("Plasticity",
                "Yielding of von Mises with linear hardening, at small plastic strains.");
  schema.add(number("Yield Stress", "N/m^2", "In tension, before any hardening.").positive())
      .add(number("Isotropic Hardening", "N/m^2",
                  "Growth of the yield stress by plastic strain, in all directions.")
               .non_negative()
               .optional(0.0))
      .add(number("Kinematic Hardening", "N/m^2",
                  "Growth of the stress about which it yields by plastic strain.")
               .non_negative()
               .optional(0.0));
  return schema;
}

std::optional<Plasticity> read_plasticity(const Options& options) {
  if (!options.has_list("Plasticity")) return {};
  const Options& list = options.list("Plasticity");
  return Plasticity{list.number("Yield Stress"), list.number("Isotropic Hardening"),
                    list.number("Kinematic Hardening")};
}

}  // namespace culm::material
