#include <culm/material/material.hpp>

#include <utility>

namespace culm::material {

const Mat6& small_strain_stiffness(const Material::Law& law) {
  return std::visit([](const auto& one) -> const Mat6& { return one.small_strain_stiffness(); },
                    law);
}

double Material::ratio_of(double time) const {
  double sum = 0.0;
  for (const MaxwellBranch& branch : relaxation) {
    if (branch.time == time) sum += branch.ratios.front();
  }
  return sum;
}

Schema common_material_schema() {
  Schema schema("Material", "What every material has.");
  schema
      .add(number("Density", "kg/m^3", "Mass per volume; may be left out in statics.")
               .non_negative()
               .optional(0.0))
      .add(number("Dissipation", "1",
                  "Numerical dissipation of fast strain changes, 0 (none) to 1, in dynamics.")
               .between(0.0, 1.0)
               .optional(0.0))
      .add(number("Damping", "s", "Physical damping: time by which stress runs ahead of strain.")
               .non_negative()
               .optional(0.0))
      .list("Relaxation", relaxation_schema(1), Presence::defaulted);
  return schema;
}

Material make_material(Material::Law law, const Options& options) {
  return {std::move(law),
          options.number("Density"),
          options.number("Dissipation"),
          options.number("Damping"),
          read_relaxation(options.list("Relaxation"), 1),
          Vec3::Zero(),
          {}};
}

}  // namespace culm::material
