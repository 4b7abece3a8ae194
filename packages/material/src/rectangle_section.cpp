#include <culm/material/rectangle_section.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::material {

namespace {

// Long side a, short side b:
//   J = a b^3 / 3 ( 1 - 192 b / (pi^5 a) sum_{n odd} tanh(n pi a / 2 b) / n^5 )
// With tanh = 1 - (1 - tanh) the slow part sums to 31/32 zeta(5); what remains dies out like
// exp(-n pi a / b).
double rectangle_torsion(double width, double height) {
  constexpr double odd_sum = 31.0 / 32.0 * 1.0369277551433699263;  // zeta(5)
  const double a = std::max(width, height);
  const double b = std::min(width, height);
  double sum = odd_sum;
  for (int n = 1; n < 16; n += 2) {
    const double x = std::exp(-n * std::numbers::pi * a / b);
    sum -= 2.0 * x / (1.0 + x) / std::pow(n, 5);  // 1 - tanh(y) = 2 exp(-2y) / (1 + exp(-2y))
  }
  return a * b * b * b / 3.0 * (1.0 - 192.0 * b / (std::pow(std::numbers::pi, 5) * a) * sum);
}

}  // namespace

// k = 10 (1 + nu) / (12 + 11 nu) in both directions
Profile RectangleSection::profile(double width, double height, double nu) {
  const double area = width * height;
  const double k = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
  return {.area = area,
          .I1 = area * height * height / 12.0,
          .I2 = area * width * width / 12.0,
          .torsion = rectangle_torsion(width, height),
          .k1 = k,
          .k2 = k,
          .outline = rectangle_outline(width, height)};
}

Schema RectangleSection::schema() {
  Schema schema =
      profile_schema("Rectangle", "Solid rectangular section of one isotropic material.");
  schema.add(number("Width", "m", "Side along d1.").positive())
      .add(number("Height", "m", "Side along d2.").positive());
  return schema;
}

Section RectangleSection::make(const Options& options) {
  const double width = options.number("Width");
  const double height = options.number("Height");
  Profile rectangle = profile(width, height, poisson_ratio(options));
  if (yields(options)) {
    const Vec<2> corner(0.5 * width, 0.5 * height);
    rectangle.pattern = {"Rectangle", cells_of(options, {8, 8})};
    rectangle.fibres = rectangle_fibres(-corner, corner, rectangle.pattern.cells);
  }
  return make_section(rectangle, options);
}

}  // namespace culm::material
