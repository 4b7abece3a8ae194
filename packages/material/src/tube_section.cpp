#include <culm/material/tube_section.hpp>

#include <fmt/format.h>

#include <numbers>

namespace culm::material {

// A = pi (r^2 - q^2) ,  I = pi (r^4 - q^4) / 4 ,  torsion 2 I ,  m = q / r:
// k = 6 (1 + nu) (1 + m^2)^2 / ( (7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2 )
Profile TubeSection::profile(double outer_radius, double wall, double nu) {
  const double inner_radius = outer_radius - wall;
  const double r2 = outer_radius * outer_radius;
  const double q2 = inner_radius * inner_radius;
  const double A = std::numbers::pi * wall * (outer_radius + inner_radius);
  const double I = 0.25 * A * (r2 + q2);
  const double m2 = q2 / r2;
  const double n = (1.0 + m2) * (1.0 + m2);
  const double k = 6.0 * (1.0 + nu) * n / ((7.0 + 6.0 * nu) * n + (20.0 + 12.0 * nu) * m2);
  return {.area = A,
          .I1 = I,
          .I2 = I,
          .torsion = 2.0 * I,
          .k1 = k,
          .k2 = k,
          .outline = circle_outline(outer_radius)};
}

Schema TubeSection::schema() {
  Schema schema = profile_schema("Tube", "Circular hollow section of one isotropic material.");
  schema.add(number("Outer Radius", "m", "Radius of the outer circle.").positive())
      .add(number("Wall Thickness", "m", "Thickness of the wall.").positive())
      .check(check_cells_around)
      .check([](const Options& tube, InputIssues& issues) {
        const double radius = tube.number("Outer Radius");
        const double wall = tube.number("Wall Thickness");
        if (wall > radius) {
          issues.add(tube.where("Wall Thickness"),
                     fmt::format("must be <= the outer radius {} m, got {}", radius, wall));
        }
      });
  return schema;
}

Section TubeSection::make(const Options& options) {
  const double radius = options.number("Outer Radius");
  const double wall = options.number("Wall Thickness");
  Profile tube = profile(radius, wall, poisson_ratio(options));
  if (yields(options)) {
    tube.pattern = {"Tube", cells_of(options, {32, 1})};
    tube.fibres = ring_fibres(radius - wall, radius, tube.pattern.cells);
  }
  return make_section(tube, options);
}

}  // namespace culm::material
