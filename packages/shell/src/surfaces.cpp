#include <culm/shell/surfaces.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::shell {

namespace {

// Unit vector from the axis z at a share of the sweep.
Vec3 radial(const Sweep& sweep, double share) {
  const double angle = sweep.from + share * (sweep.to - sweep.from);
  return {std::cos(angle), std::sin(angle), 0.0};
}

Surface along_line(const Vec<2>& from, const Vec<2>& to, double length) {
  return plane(Vec3(from[0], from[1], 0.0), Vec3(to[0] - from[0], to[1] - from[1], 0.0),
               Vec3(0.0, 0.0, length));
}

// A patch drawn along z, whose sides across it join those of all others.
void add_wall(Facets& facets, const Surface& surface, int across, int along,
              const std::string& name, int refinement) {
  Facets wall = patch(surface, across, along, name, refinement);
  auto& edges = wall.edges;
  edges["start"] = edges[name + " v0"];
  edges["end"] = edges[name + " v1"];
  facets.append(wall);
}

}  // namespace

Surface plane(const Vec3& origin, const Vec3& side1, const Vec3& side2) {
  const Vec3 normal = side1.cross(side2).normalized();
  return {[=](double u, double v) -> Vec3 { return origin + u * side1 + v * side2; },
          [=](double, double) { return normal; }};
}

Surface cylinder(double radius, double length, Sweep sweep) {
  return cone(radius, radius, length, sweep);
}

Surface sphere(double radius, double latitude_from, double latitude_to, Sweep sweep) {
  const auto normal = [=](double u, double v) -> Vec3 {
    const double latitude = latitude_from + v * (latitude_to - latitude_from);
    return std::cos(latitude) * radial(sweep, u) + std::sin(latitude) * Vec3::UnitZ();
  };
  return {[=](double u, double v) -> Vec3 { return radius * normal(u, v); }, normal};
}

Surface cone(double radius_below, double radius_above, double height, Sweep sweep) {
  const double widening = radius_above - radius_below;
  return {[=](double u, double v) -> Vec3 {
            return (radius_below + v * widening) * radial(sweep, u) + v * height * Vec3::UnitZ();
          },
          [=](double u, double) -> Vec3 {
            return (height * radial(sweep, u) - widening * Vec3::UnitZ()).normalized();
          }};
}

Surface annulus(double inner_radius, double outer_radius, Sweep sweep) {
  return {[=](double u, double v) -> Vec3 {
            return (inner_radius + u * (outer_radius - inner_radius)) * radial(sweep, v);
          },
          [](double, double) -> Vec3 { return Vec3::UnitZ(); }};
}

Surface hypar(double side, double rise) {
  const auto place = [=](double u, double v) -> Vec<2> {
    return {(u - 0.5) * side, (v - 0.5) * side};
  };
  return {[=](double u, double v) -> Vec3 {
            const Vec<2> x = place(u, v);
            return {x[0], x[1], rise * (x[0] * x[0] - x[1] * x[1])};
          },
          [=](double u, double v) -> Vec3 {
            const Vec<2> x = place(u, v);
            return Vec3(-2.0 * rise * x[0], 2.0 * rise * x[1], 1.0).normalized();
          }};
}

Surface twisted_strip(double length, double width, double twist) {
  const auto across = [=](double u) -> Vec3 {
    return {0.0, std::cos(twist * u), std::sin(twist * u)};
  };
  return {[=](double u, double v) -> Vec3 {
            return u * length * Vec3::UnitX() + (v - 0.5) * width * across(u);
          },
          [=](double u, double v) -> Vec3 {
            const Vec3 along =
                length * Vec3::UnitX() + (v - 0.5) * width * twist * Vec3::UnitX().cross(across(u));
            return along.cross(across(u)).normalized();
          }};
}

Surface extrusion(PlaneCurve curve, double length) {
  const auto normal = [curve](double s, double) -> Vec3 {
    constexpr double h = 1e-3;  // fourth order: exact to about 1e-12
    const Vec<2> tangent = (curve(s - 2.0 * h) - curve(s + 2.0 * h)) / 12.0 +
                           (curve(s + h) - curve(s - h)) * (2.0 / 3.0);
    return Vec3(tangent[1], -tangent[0], 0.0).normalized();
  };
  return {[curve, length](double s, double v) -> Vec3 {
            const Vec<2> x = curve(s);
            return {x[0], x[1], v * length};
          },
          normal};
}

Facets patch(const Surface& surface, int nu_coarse, int nv_coarse, const std::string& name,
             int refinement) {
  const int nu = nu_coarse * refinement;
  const int nv = nv_coarse * refinement;
  Facets facets;
  const auto u = [&](int i) { return static_cast<double>(i) / nu; };
  const auto v = [&](int j) { return static_cast<double>(j) / nv; };
  const auto at = [&](int i, int j) { return j * (nu + 1) + i; };
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) facets.points.push_back(surface.point(u(i), v(j)));
  }
  auto& part = facets.parts[name];
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      part.push_back(static_cast<int>(facets.quads.size()));
      facets.parents.push_back(j / refinement * nu_coarse + i / refinement);
      facets.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      facets.normals.push_back({surface.normal(u(i), v(j)), surface.normal(u(i + 1), v(j)),
                                surface.normal(u(i + 1), v(j + 1)),
                                surface.normal(u(i), v(j + 1))});
    }
  }
  const auto quad = [&](int i, int j) { return j * nu + i; };
  for (int j = 0; j < nv; ++j) {
    facets.edges[name + " u0"].insert(facets.edges[name + " u0"].end(),
                                      {{quad(0, j), 0}, {quad(0, j), 3}});
    facets.edges[name + " u1"].insert(facets.edges[name + " u1"].end(),
                                      {{quad(nu - 1, j), 1}, {quad(nu - 1, j), 2}});
  }
  for (int i = 0; i < nu; ++i) {
    facets.edges[name + " v0"].insert(facets.edges[name + " v0"].end(),
                                      {{quad(i, 0), 0}, {quad(i, 0), 1}});
    facets.edges[name + " v1"].insert(facets.edges[name + " v1"].end(),
                                      {{quad(i, nv - 1), 3}, {quad(i, nv - 1), 2}});
  }
  return facets;
}

Facets i_section(const ISection& section, double length, int flange, int web, int along,
                 int refinement) {
  const double y = 0.5 * section.height;
  const double top = 0.5 * section.top_width;
  const double bottom = 0.5 * section.bottom_width;
  Facets facets;
  add_wall(facets, along_line({0.0, -y}, {0.0, y}, length), web, along, "web", refinement);
  // flanges run so that their normals point away from the web
  add_wall(facets, along_line({top, y}, {0.0, y}, length), flange, along, "top right", refinement);
  add_wall(facets, along_line({0.0, y}, {-top, y}, length), flange, along, "top left", refinement);
  add_wall(facets, along_line({-bottom, -y}, {0.0, -y}, length), flange, along, "bottom left",
           refinement);
  add_wall(facets, along_line({0.0, -y}, {bottom, -y}, length), flange, along, "bottom right",
           refinement);
  return facets;
}

PlaneCurve naca_profile(double chord, double thickness) {
  return [=](double s) -> Vec<2> {
    const double root = 1.0 - 2.0 * s;  // ± sqrt(x), + on the upper side
    const double x = root * root;
    const double rest = x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x)));
    const double y = 5.0 * thickness * (0.2969 * root + (root < 0.0 ? -rest : rest));
    return {chord * x, chord * y};
  };
}

Facets airfoil(double chord, double thickness, double length, const std::vector<double>& webs,
               int around, int across, int along, int refinement) {
  // places of the webs on the profile: down the upper side, then back on the lower one
  std::vector<double> stations{0.0};
  for (auto web = webs.rbegin(); web != webs.rend(); ++web) {
    stations.push_back(0.5 - 0.5 * std::sqrt(*web));
  }
  for (double web : webs) stations.push_back(0.5 + 0.5 * std::sqrt(web));
  stations.push_back(1.0);

  const PlaneCurve profile = naca_profile(chord, thickness);
  Facets facets;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const double from = stations[i];
    const double share = stations[i + 1] - from;
    const int elements = std::max(1, static_cast<int>(std::lround(around * share)));
    const auto piece = [=](double s) { return profile(from + s * share); };
    add_wall(facets, extrusion(piece, length), elements, along, "skin", refinement);
  }
  facets.edges.erase("skin u0");  // the sides of its pieces are no edges of the skin
  facets.edges.erase("skin u1");
  for (std::size_t i = 0; i < webs.size(); ++i) {
    const Vec<2> above = profile(stations[webs.size() - i]);
    add_wall(facets, along_line(profile(stations[webs.size() + 1 + i]), above, length), across,
             along, fmt::format("web {}", i + 1), refinement);
  }
  return facets;
}

}  // namespace culm::shell
