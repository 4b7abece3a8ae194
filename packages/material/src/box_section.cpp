#include <culm/material/box_section.hpp>

#include <fmt/format.h>

namespace culm::material {

namespace {

// Flanges over the whole width, webs between them.
std::vector<Fibre> wall_fibres(const BoxSection::Walls& w, const Cells& cells) {
  const Vec<2> outer(0.5 * w.width, 0.5 * w.height);
  const Vec<2> inner = outer - Vec<2>(w.web, w.flange);
  std::vector<Fibre> fibres;
  const auto add = [&](const Vec<2>& from, const Vec<2>& to, const Cells& of_wall) {
    const std::vector<Fibre> wall = rectangle_fibres(from, to, of_wall);
    fibres.insert(fibres.end(), wall.begin(), wall.end());
  };
  add(-outer, {outer[0], -inner[1]}, {cells[0], 1});
  add({-outer[0], inner[1]}, outer, {cells[0], 1});
  add({-outer[0], -inner[1]}, {-inner[0], inner[1]}, {1, cells[1]});
  add({inner[0], -inner[1]}, {outer[0], inner[1]}, {1, cells[1]});
  return fibres;
}

// Shear along the walls of thickness t and depth h, between walls of thickness t1 and width b, all
// on the midline; m = b t1 / (h t), n = b / h:
//   k = 10 (1 + nu) (1 + 3 m)^2 / ( 12 + 72 m + 150 m^2 + 90 m^3
//         + nu (11 + 66 m + 135 m^2 + 90 m^3) + 10 n^2 ((3 + nu) m + 3 m^2) )
double shear_factor(double b, double t1, double h, double t, double nu) {
  const double m = b * t1 / (h * t);
  const double n = b / h;
  const double below = 12.0 + m * (72.0 + m * (150.0 + m * 90.0)) +
                       nu * (11.0 + m * (66.0 + m * (135.0 + m * 90.0))) +
                       10.0 * n * n * m * (3.0 + nu + 3.0 * m);
  return 10.0 * (1.0 + nu) * (1.0 + 3.0 * m) * (1.0 + 3.0 * m) / below;
}

}  // namespace

// Bredt: torsion = 4 Am^2 / (closed integral of ds / t), Am the area within the midline
Profile BoxSection::profile(const Walls& w, double nu) {
  const double inner_width = w.width - 2.0 * w.web;
  const double inner_height = w.height - 2.0 * w.flange;
  const double outer = w.width * w.height;
  const double inner = inner_width * inner_height;
  const double b = w.width - w.web;
  const double h = w.height - w.flange;
  return {.area = outer - inner,
          .I1 = (outer * w.height * w.height - inner * inner_height * inner_height) / 12.0,
          .I2 = (outer * w.width * w.width - inner * inner_width * inner_width) / 12.0,
          .torsion = 4.0 * b * b * h * h / (2.0 * b / w.flange + 2.0 * h / w.web),
          .k1 = shear_factor(h, w.web, b, w.flange, nu),
          .k2 = shear_factor(b, w.flange, h, w.web, nu),
          .outline = rectangle_outline(w.width, w.height)};
}

Schema BoxSection::schema() {
  Schema schema =
      profile_schema("Box", "Thin-walled rectangular hollow section of one isotropic material.");
  schema.add(number("Width", "m", "Outer side along d1.").positive())
      .add(number("Height", "m", "Outer side along d2.").positive())
      .add(number("Flange Thickness", "m", "Thickness of the walls parallel to d1.").positive())
      .add(number("Web Thickness", "m", "Thickness of the walls parallel to d2.").positive())

      .check([](const Options& box, InputIssues& issues) {
        const auto check = [&](const std::string& wall, const std::string& side) {
          if (2.0 * box.number(wall) >= box.number(side)) {
            issues.add(box.where(wall), fmt::format("must be < half of '{}' {} m, got {}", side,
                                                    box.number(side), box.number(wall)));
          }
        };
        check("Flange Thickness", "Height");
        check("Web Thickness", "Width");
      });
  return schema;
}

Section BoxSection::make(const Options& options) {
  const Walls walls{.width = options.number("Width"),
                    .height = options.number("Height"),
                    .flange = options.number("Flange Thickness"),
                    .web = options.number("Web Thickness")};
  Profile box = profile(walls, poisson_ratio(options));
  if (yields(options)) {
    box.pattern = {"Box", cells_of(options, {8, 8})};
    box.fibres = wall_fibres(walls, box.pattern.cells);
  }
  return make_section(box, options);
}

}  // namespace culm::material
