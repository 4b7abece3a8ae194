#include <culm/base/read_file.hpp>
#include <culm/math/rotation.hpp>
#include <culm/shell/gmsh_reader.hpp>
#include <culm/shell/mesh_types.hpp>
#include <culm/shell/surfaces.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <utility>

namespace culm::shell {

namespace {

Vec3 vector(const Options& options, const std::string& name) {
  return Eigen::Map<const Vec3>(options.numbers(name).data());
}

Field vector_field(const std::string& name, const std::string& unit, const std::string& doc) {
  return numbers(name, unit, doc).size(3);
}

Field length_field(const std::string& name, const std::string& doc) {
  return number(name, "m", doc).positive();
}

Field elements_field(const std::string& doc) {
  return integers("Elements", doc).at_least(1).size(2);
}

Schema with_sweep(Schema schema) {
  return schema
      .add(number("From", "rad", "Angle about z at which the surface starts, from x towards y.")
               .optional(0.0))
      .add(number("To", "rad", "Angle at which it ends; a full turn closes the surface.")
               .optional(6.283185307179586))
      .check([](const Options& options, InputIssues& issues) {
        constexpr double turn = 2.0 * std::numbers::pi;
        const double swept = std::abs(options.number("To") - options.number("From"));
        if (swept <= turn * (1.0 + 1e-9)) return;
        issues.add(options.where("To"),
                   fmt::format("the surface sweeps {:.6g} rad from 'From' = {:g} and lies upon "
                               "itself; it must sweep a full turn, {:.10g} rad, at most",
                               swept, options.number("From"), turn));
      });
}

Sweep sweep(const Options& options) { return {options.number("From"), options.number("To")}; }

// Every type says where its own frame lies.
Schema with_placement(Schema schema) {
  return schema
      .add(vector_field("Origin", "m", "Where the origin of the surface's own frame lies.")
               .optional({0.0, 0.0, 0.0}))
      .add(vector_field("Rotation", "rad",
                        "How that frame is turned: a vector along the axis, as long as the angle.")
               .optional({0.0, 0.0, 0.0}));
}

Facets placed(Facets facets, const Options& options) {
  const Mat3 R = exp_rotation(vector(options, "Rotation"));
  const Vec3 origin = vector(options, "Origin");
  for (Vec3& x : facets.points) x = origin + R * x;
  for (auto& corners : facets.normals) {
    for (Vec3& n : corners) n = R * n;
  }
  return facets;
}

void add_type(MeshRegistry& registry, Schema schema,
              const std::function<Facets(const Options&, int)>& make) {
  const std::string name = schema.name();
  registry.add(name, with_placement(std::move(schema)),
               [make](const Options& options, int refinement) {
                 return placed(make(options, refinement), options);
               });
}

// One patch whose edges are u0, u1, v0, v1.
void add_surface(MeshRegistry& registry, Schema schema,
                 const std::function<Surface(const Options&)>& make) {
  add_type(registry,
           schema.add(elements_field("Elements along u and along v: of the sides u0, u1 and v0, v1 "
                                     "the first run along v, the others along u.")),
           [make](const Options& options, int refinement) {
             const std::vector<int>& n = options.integers("Elements");
             Facets facets = patch(make(options), n[0], n[1], "surface", refinement);
             for (const char* side : {"u0", "u1", "v0", "v1"}) {
               auto edge = facets.edges.extract(std::string("surface ") + side);
               edge.key() = side;
               facets.edges.insert(std::move(edge));
             }
             return facets;
           });
}

Facets read_gmsh_file(const std::string& name, const Where& where) {
  const std::string path = (std::filesystem::path(where.file).parent_path() / name).string();
  return read_gmsh(read_file(path, where), path);
}

Facets read_quads(const Options& options) {
  Facets facets;
  const std::vector<double>& x = options.numbers("Points");
  for (std::size_t i = 0; i + 2 < x.size(); i += 3)
    facets.points.emplace_back(x[i], x[i + 1], x[i + 2]);
  const std::vector<int>& corners = options.integers("Quads");
  for (std::size_t i = 0; i + 3 < corners.size(); i += 4) {
    std::array<Vec3, 4> points;
    for (std::size_t k = 0; k < 4; ++k) {
      const int number = corners[i + k];
      if (number >= static_cast<int>(facets.points.size())) {
        throw InputError(options.where("Quads"), "point " + std::to_string(number) +
                                                     " does not exist; 'Points' has 0 to " +
                                                     std::to_string(facets.points.size() - 1));
      }
      points[k] = facets.points[static_cast<std::size_t>(number)];
    }
    facets.quads.push_back({corners[i], corners[i + 1], corners[i + 2], corners[i + 3]});
    facets.normals.push_back(corner_normals(points));
  }
  return facets;
}

}  // namespace

FacetCount count_facets(const Options& mesh) {
  const std::string& type = mesh.text("Type");
  if (type == "Gmsh") return {};
  if (type == "Quads") return {static_cast<double>(mesh.integers("Quads").size()) / 4.0};
  const auto grid = [](double across, double along) {
    return FacetCount{across * along, std::min(across, along)};
  };
  const std::vector<double> n(mesh.integers("Elements").begin(), mesh.integers("Elements").end());
  if (type == "I Section") return grid(4.0 * n[0] + n[1], n[2]);
  if (type == "Airfoil") {
    return grid(n[0] + n[1] * static_cast<double>(mesh.numbers("Webs").size()), n[2]);
  }
  return grid(n[0], n[1]);
}

void register_meshes(MeshRegistry& registry) {
  add_surface(registry,
              Schema("Plane", "A parallelogram.")
                  .add(vector_field("Side 1", "m", "From the origin along u."))
                  .add(vector_field("Side 2", "m",
                                    "From the origin along v; the normal is their "
                                    "vector product.")),
              [](const Options& o) {
                return plane(Vec3::Zero(), vector(o, "Side 1"), vector(o, "Side 2"));
              });
  add_surface(
      registry,
      with_sweep(Schema("Cylinder", "About z from z = 0; u around, v along, normal outward.")
                     .add(length_field("Radius", "Radius of the middle surface."))
                     .add(length_field("Length", "Extent along z."))),
      [](const Options& o) { return cylinder(o.number("Radius"), o.number("Length"), sweep(o)); });
  add_surface(
      registry,
      with_sweep(
          Schema("Sphere", "A zone between two latitudes; u around, v up, normal outward.")
              .add(length_field("Radius", "Radius of the middle surface."))
              .add(number("Latitude From", "rad", "Latitude at which it starts.")
                       .between(-1.57, 1.57)
                       .optional(0.0))
              .add(
                  number("Latitude To", "rad", "Latitude at which it ends.").between(-1.57, 1.57))),
      [](const Options& o) {
        return sphere(o.number("Radius"), o.number("Latitude From"), o.number("Latitude To"),
                      sweep(o));
      });
  add_surface(registry,
              with_sweep(Schema("Cone", "About z from z = 0; u around, v up, normal outward.")
                             .add(number("Radius Below", "m", "Radius at z = 0.").non_negative())
                             .add(number("Radius Above", "m", "Radius at the top.").non_negative())
                             .add(length_field("Height", "Extent along z."))),
              [](const Options& o) {
                return cone(o.number("Radius Below"), o.number("Radius Above"), o.number("Height"),
                            sweep(o));
              });
  add_surface(registry,
              with_sweep(Schema("Annulus", "In the plane z = 0; u outward, v around, normal z.")
                             .add(length_field("Inner Radius", "Inner radius."))
                             .add(length_field("Outer Radius", "Outer radius."))),
              [](const Options& o) {
                return annulus(o.number("Inner Radius"), o.number("Outer Radius"), sweep(o));
              });
  add_surface(registry,
              Schema("Hypar", "z = Rise (x^2 - y^2) over a square about the origin.")
                  .add(length_field("Side", "Side of the square."))
                  .add(number("Rise", "1/m", "How steep it is.")),
              [](const Options& o) { return hypar(o.number("Side"), o.number("Rise")); });
  add_surface(registry,
              Schema("Twisted Strip", "A strip along x that turns about it; u along x, v across.")
                  .add(length_field("Length", "Extent along x."))
                  .add(length_field("Width", "Extent across, along y at the start."))
                  .add(number("Twist", "rad", "Angle from start to end, from y towards z.")),
              [](const Options& o) {
                return twisted_strip(o.number("Length"), o.number("Width"), o.number("Twist"));
              });
  add_type(
      registry,
      Schema("I Section",
             "A beam of I-section along z; flanges across x, web along y. Edges 'start', 'end'.")
          .add(length_field("Height", "Between the middle surfaces of the flanges."))
          .add(length_field("Top Width", "Width of the flange at +y."))
          .add(length_field("Bottom Width", "Width of the flange at -y."))
          .add(length_field("Length", "Extent along z."))
          .add(
              integers("Elements", "Over half a flange, the web, the length.").at_least(1).size(3)),
      [](const Options& o, int refinement) {
        const std::vector<int>& n = o.integers("Elements");
        return i_section({o.number("Height"), o.number("Top Width"), o.number("Bottom Width")},
                         o.number("Length"), n[0], n[1], n[2], refinement);
      });
  add_type(
      registry,
      Schema("Airfoil",
             "A closed symmetric profile (NACA, four digits) along z with webs; chord along x from "
             "the nose at 0. Edges 'start', 'end'.")
          .add(length_field("Chord", "Length of the chord."))
          .add(number("Relative Thickness", "1", "Largest thickness over chord.").positive())
          .add(length_field("Length", "Extent along z."))
          .add(numbers("Webs", "1", "Places of the webs on the chord, ascending.")
                   .between(0.01, 0.99)
                   .optional({0.3}))
          .add(integers("Elements", "Around the skin, over the height of a web, along the length.")
                   .at_least(1)
                   .size(3)),
      [](const Options& o, int refinement) {
        const std::vector<int>& n = o.integers("Elements");
        return airfoil(o.number("Chord"), o.number("Relative Thickness"), o.number("Length"),
                       o.numbers("Webs"), n[0], n[1], n[2], refinement);
      });
  add_type(
      registry,
      Schema("Quads", "Points and quadrilaterals, written out.")
          .add(numbers("Points", "m", "x, y, z of all points.").size_multiple_of(3).min_size(12))
          .add(integers("Quads",
                        "Four numbers of points each, from 0, counter-clockwise seen from "
                        "the side the normal points to.")
                   .at_least(0)
                   .size_multiple_of(4)
                   .min_size(4)),
      [](const Options& o, int) { return read_quads(o); });
  add_type(registry,
           Schema("Gmsh",
                  "Quadrilaterals of a Gmsh file, MSH 2.2 or 4.1 in ASCII; physical curves and "
                  "points become node sets, physical surfaces element sets.")
               .add(text("File Name", "Relative to the deck.")),
           [](const Options& o, int) {
             return read_gmsh_file(o.text("File Name"), o.where("File Name"));
           });
}

}  // namespace culm::shell
