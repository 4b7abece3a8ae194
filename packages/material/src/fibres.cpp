#include <culm/material/fibres.hpp>
#include <culm/material/plasticity.hpp>
#include <culm/math/quadrature.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace culm::material {
namespace {

// Two Gauss points in each of some cells of an interval.
std::vector<QuadraturePoint> points_between(double from, double to, int cells) {
  std::vector<QuadraturePoint> points;
  const double half = 0.5 * (to - from) / cells;
  for (int cell = 0; cell < cells; ++cell) {
    for (const QuadraturePoint& point : gauss_legendre(2)) {
      points.push_back({from + half * (2 * cell + 1 + point.xi), half * point.weight});
    }
  }
  return points;
}

}  // namespace

std::vector<Fibre> rectangle_fibres(const Vec<2>& from, const Vec<2>& to, const Cells& cells) {
  std::vector<Fibre> fibres;
  for (const QuadraturePoint& y : points_between(from[1], to[1], cells[1])) {
    for (const QuadraturePoint& x : points_between(from[0], to[0], cells[0])) {
      fibres.push_back({{x.xi, y.xi}, x.weight * y.weight});
    }
  }
  return fibres;
}

std::vector<Fibre> ring_fibres(double inner_radius, double outer_radius, const Cells& cells) {
  std::vector<Fibre> fibres;
  const double angle = 2.0 * std::numbers::pi / cells[0];
  for (const QuadraturePoint& r : points_between(inner_radius, outer_radius, cells[1])) {
    for (int i = 0; i < cells[0]; ++i) {
      const double at = (i + 0.5) * angle;
      fibres.push_back({r.xi * Vec<2>(std::cos(at), std::sin(at)), r.weight * r.xi * angle});
    }
  }
  return fibres;
}

Schema fibre_schema() {
  Schema list = plasticity_schema();
  list.add(
      integers("Cells",
               "Cells of the section, even numbers best: along d1 and d2 of a rectangle, along "
               "flange and web of a box, with two fibres in each direction; around and across "
               "circle and tube, with one and two.")
          .size(2)
          .between(1, 1000)
          .optional());
  Schema schema("");
  schema.list("Plasticity", std::move(list), Presence::optional);
  return schema;
}

void check_cells_around(const Options& section, InputIssues& issues) {
  if (!yields(section)) return;
  const Options& list = section.list("Plasticity");
  if (!list.has("Cells") || list.integers("Cells")[0] >= 4) return;
  issues.add(list.where("Cells"),
             "must be at least 4 around, got " + std::to_string(list.integers("Cells")[0]));
}

bool yields(const Options& section) { return section.has_list("Plasticity"); }

Cells cells_of(const Options& section, const Cells& good) {
  const Options& list = section.list("Plasticity");
  if (!list.has("Cells")) return good;
  return {list.integers("Cells")[0], list.integers("Cells")[1]};
}

}  // namespace culm::material
