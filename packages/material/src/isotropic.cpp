#include <culm/material/expansion.hpp>
#include <culm/material/isotropic.hpp>

#include <utility>

namespace culm::material {

Mat6 lame_stiffness(double lambda, double mu) {
  Mat6 C = Mat6::Zero();
  C.topLeftCorner<3, 3>().setConstant(lambda);
  C.diagonal() += (Vec6() << 2.0 * mu, 2.0 * mu, 2.0 * mu, mu, mu, mu).finished();
  return C;
}

Schema isotropic_constants_schema(std::string type, std::string doc) {
  Schema schema(std::move(type), std::move(doc));
  schema.add(number("Young Modulus", "N/m^2", "Modulus of elasticity E.").positive())
      .add(number("Poisson Ratio", "1", "Ratio of lateral to axial strain.")
               .greater_than(-1.0)
               .less_than(0.5))
      .add_all(common_material_schema());
  return schema;
}

StVenantKirchhoff IsotropicMaterial::law(double E, double nu) {
  const double mu = E / (2.0 * (1.0 + nu));
  return {lame_stiffness(2.0 * mu * nu / (1.0 - 2.0 * nu), mu)};
}

Schema IsotropicMaterial::schema() {
  Schema schema = isotropic_constants_schema(
      "Isotropic", "Stress proportional to Green-Lagrange strain, the same in all directions.");
  Schema plasticity = plasticity_schema();
  plasticity.add(
      integer("Cells",
              "Cells across the thickness of each layer, with three points each; an even number "
              "gives the full plastic moment of one layer exactly.")
          .between(1, 100)
          .optional(4));
  schema.add(expansion_field()).list("Plasticity", std::move(plasticity), Presence::optional);
  return schema;
}

Material IsotropicMaterial::make(const Options& options) {
  Material material =
      make_material(law(options.number("Young Modulus"), options.number("Poisson Ratio")), options);
  material.expansion.setConstant(options.number("Expansion"));
  if (const auto constants = read_plasticity(options)) {
    material.plasticity = {
        {options.number("Young Modulus"), options.number("Poisson Ratio"), *constants},
        options.list("Plasticity").integer("Cells")};
  }
  return material;
}

}  // namespace culm::material
