#include <culm/material/expansion.hpp>
#include <culm/material/placement.hpp>
#include <culm/material/plasticity.hpp>
#include <culm/material/profile.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace culm::material {

namespace {

double shear_modulus(const Options& options) {
  if (options.has("Shear Modulus")) return options.number("Shear Modulus");
  return options.number("Young Modulus") / (2.0 * (1.0 + options.number("Poisson Ratio")));
}

// One of the two says how the material shears; a shear modulus that no isotropic solid has is
// welcome as long as nothing must be computed from the ratio it would imply.
void check_material(const Options& options, InputIssues& issues) {
  if (options.has("Poisson Ratio") == options.has("Shear Modulus")) {
    issues.add(options.where(), "give one of 'Poisson Ratio' and 'Shear Modulus'");
    return;
  }
  const double nu = poisson_ratio(options);
  if (!options.has("Shear Factor") && !(nu > -1.0 && nu <= 0.5)) {
    issues.add(options.where("Shear Modulus"),
               fmt::format("implies a Poisson ratio of {:.4g}, outside (-1, 0.5]; give 'Shear "
                           "Factor' as well",
                           nu));
  }
}

}  // namespace

Schema profile_schema(std::string type, std::string doc) {
  Schema schema(std::move(type), std::move(doc));
  schema.add(number("Young Modulus", "N/m^2", "Modulus of elasticity E.").positive())
      .add(number("Poisson Ratio", "1",
                  "Ratio of lateral to axial strain; or give the shear modulus.")
               .greater_than(-1.0)
               .at_most(0.5)
               .optional())
      .add(number("Shear Modulus", "N/m^2", "Modulus of shear G; or give the Poisson ratio.")
               .positive()
               .optional())
      .add(number("Density", "kg/m^3", "Mass per volume; may be left out in statics.")
               .non_negative()
               .optional(0.0))
      .add(numbers("Shear Factor", "1",
                   "Shear areas along d1 and d2 as fractions of the area, instead of Cowper's.")
               .size(2)
               .positive()
               .optional())
      .add(number("Torsion Constant", "m^4", "Torsion constant, instead of that of the shape.")
               .positive()
               .optional())
      .add(expansion_field())
      .add_all(placement_schema())
      .add_all(fibre_schema())
      .check(check_material);
  return schema;
}

double poisson_ratio(const Options& options) {
  if (options.has("Poisson Ratio")) return options.number("Poisson Ratio");
  return options.number("Young Modulus") / (2.0 * options.number("Shear Modulus")) - 1.0;
}

Section make_section(const Profile& profile, const Options& options) {
  const double E = options.number("Young Modulus");
  const double G = shear_modulus(options);
  const double rho = options.number("Density");
  double k1 = profile.k1;
  double k2 = profile.k2;
  if (options.has("Shear Factor")) {
    k1 = options.numbers("Shear Factor")[0];
    k2 = options.numbers("Shear Factor")[1];
  }
  const double torsion =
      options.has("Torsion Constant") ? options.number("Torsion Constant") : profile.torsion;
  Section section;
  section.stiffness = stiffness_matrix({.EA = E * profile.area,
                                        .GA1 = k1 * G * profile.area,
                                        .GA2 = k2 * G * profile.area,
                                        .EI1 = E * profile.I1,
                                        .EI2 = E * profile.I2,
                                        .GIp = G * torsion});
  section.mass = mass_matrix(
      {.rhoA = rho * profile.area, .rhoI1 = rho * profile.I1, .rhoI2 = rho * profile.I2});
  section.outline = profile.outline;
  section.expansion = options.number("Expansion");
  if (const auto plasticity = read_plasticity(options)) {
    section.fibres = profile.fibres;
    section.pattern = profile.pattern;
    section.plasticity = {E, *plasticity};
  }
  return place(section, options);
}

std::vector<Vec<2>> circle_outline(double radius) {
  constexpr int corners = 24;
  std::vector<Vec<2>> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

std::vector<Vec<2>> rectangle_outline(double width, double height) {
  const double x = 0.5 * width;
  const double y = 0.5 * height;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

}  // namespace culm::material
