#include <culm/material/circle_section.hpp>

#include <numbers>

namespace culm::material {

// A = pi r^2 ,  I = pi r^4 / 4 ,  torsion 2 I ,  k = 6 (1 + nu) / (7 + 6 nu)
Profile CircleSection::profile(double radius, double nu) {
  const double r2 = radius * radius;
  const double I = 0.25 * std::numbers::pi * r2 * r2;
  const double k = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
  return {.area = std::numbers::pi * r2,
          .I1 = I,
          .I2 = I,
          .torsion = 2.0 * I,
          .k1 = k,
          .k2 = k,
          .outline = circle_outline(radius)};
}

Schema CircleSection::schema() {
  Schema schema = profile_schema("Circle", "Solid circular section of one isotropic material.");
  schema.add(number("Radius", "m", "Radius of the circle.").positive()).check(check_cells_around);
  return schema;
}

Section CircleSection::make(const Options& options) {
  const double radius = options.number("Radius");
  Profile circle = profile(radius, poisson_ratio(options));
  if (yields(options)) {
    circle.pattern = {"Circle", cells_of(options, {24, 6})};
    circle.fibres = ring_fibres(0.0, radius, circle.pattern.cells);
  }
  return make_section(circle, options);
}

}  // namespace culm::material
