#include <culm/material/orthotropic.hpp>

#include <Eigen/Dense>
#include <fmt/format.h>

namespace culm::material {

namespace {

OrthotropicConstants read(const Options& options) {
  const auto value = [&](const char* name) { return options.number(name); };
  return {.E1 = value("E1"),
          .E2 = value("E2"),
          .E3 = value("E3"),
          .nu12 = value("nu12"),
          .nu13 = value("nu13"),
          .nu23 = value("nu23"),
          .G12 = value("G12"),
          .G13 = value("G13"),
          .G23 = value("G23")};
}

// Compliance of the normal components; the shears stand alone.
Mat3 normal_compliance(const OrthotropicConstants& c) {
  Mat3 S;
  S << 1.0 / c.E1, -c.nu12 / c.E1, -c.nu13 / c.E1,  //
      -c.nu12 / c.E1, 1.0 / c.E2, -c.nu23 / c.E2,   //
      -c.nu13 / c.E1, -c.nu23 / c.E2, 1.0 / c.E3;
  return S;
}

}  // namespace

std::vector<std::string> OrthotropicMaterial::mistakes(const OrthotropicConstants& c) {
  std::vector<std::string> messages;
  const auto check_pair = [&](const char* name, double nu, double Ei, double Ej) {
    if (nu * nu * Ej >= Ei) {
      messages.push_back(fmt::format("{} = {} is too large: {}^2 E{}/E{} must be < 1, is {:.4g}",
                                     name, nu, name, name[3], name[2], nu * nu * Ej / Ei));
    }
  };
  check_pair("nu12", c.nu12, c.E1, c.E2);
  check_pair("nu13", c.nu13, c.E1, c.E3);
  check_pair("nu23", c.nu23, c.E2, c.E3);
  // scaled to a unit diagonal, so that the determinant has no unit
  const Vec3 root(std::sqrt(c.E1), std::sqrt(c.E2), std::sqrt(c.E3));
  const double determinant =
      (root.asDiagonal() * normal_compliance(c) * root.asDiagonal()).determinant();
  if (messages.empty() && determinant <= 1e-12) {
    messages.push_back(fmt::format(
        "the three Poisson ratios do not fit together: the stiffness would not be positive "
        "definite (scaled determinant of the compliance {:.4g})",
        determinant));
  }
  return messages;
}

StVenantKirchhoff OrthotropicMaterial::law(const OrthotropicConstants& c) {
  StVenantKirchhoff law;
  law.C.setZero();
  const Mat3 C = normal_compliance(c).inverse();
  law.C.topLeftCorner<3, 3>() = 0.5 * (C + C.transpose());
  law.C(3, 3) = c.G23;
  law.C(4, 4) = c.G13;
  law.C(5, 5) = c.G12;
  return law;
}

Schema OrthotropicMaterial::schema() {
  Schema schema("Orthotropic",
                "Stress proportional to Green-Lagrange strain, with three planes of symmetry.");
  schema.add(number("E1", "N/m^2", "Young's modulus along the fibre.").positive())
      .add(number("E2", "N/m^2", "Young's modulus across the fibre, in the layer.").positive())
      .add(number("E3", "N/m^2", "Young's modulus through the thickness.").positive())
      .add(number("nu12", "1", "Contraction in 2 under tension in 1."))
      .add(number("nu13", "1", "Contraction in 3 under tension in 1."))
      .add(number("nu23", "1", "Contraction in 3 under tension in 2."))
      .add(number("G12", "N/m^2", "Shear modulus in the layer.").positive())
      .add(number("G13", "N/m^2", "Transverse shear modulus, along the fibre.").positive())
      .add(number("G23", "N/m^2", "Transverse shear modulus, across the fibre.").positive())
      .add(numbers("Expansions", "1/K",
                   "Coefficients of thermal expansion along the fibre, across it in the layer and "
                   "through the thickness, for heat.")
               .size(3)
               .optional({0.0, 0.0, 0.0}))
      .add_all(common_material_schema())
      .check([](const Options& options, InputIssues& issues) {
        for (const std::string& message : mistakes(read(options))) {
          issues.add(options.where(), message);
        }
      });
  return schema;
}

Material OrthotropicMaterial::make(const Options& options) {
  Material material = make_material(law(read(options)), options);
  material.expansion = Eigen::Map<const Vec3>(options.numbers("Expansions").data());
  return material;
}

}  // namespace culm::material
