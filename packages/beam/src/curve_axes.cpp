#include "curve_axes.hpp"

#include <culm/base/error.hpp>
#include <culm/beam/span_table.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace culm::beam {

namespace {

Vec3 vector(const Options& options, const std::string& name) {
  return Eigen::Map<const Vec3>(options.numbers(name).data());
}

Field point_field(std::string name, std::string doc) {
  return numbers(std::move(name), "m", std::move(doc)).size(3);
}
Field direction_field(std::string name, std::string doc) {
  return numbers(std::move(name), "1", std::move(doc)).size(3);
}

void require_direction(const Options& options, const std::string& name, InputIssues& issues) {
  if (vector(options, name).norm() == 0.0) {
    issues.add(options.where(name), "must not be zero");
  }
}

// Sections may jump, but what stands on them may not.
void check_twist(const Options& curve, InputIssues& issues) {
  const std::vector<double>&angles = curve.numbers("Pre-Twist"),
        &positions = curve.numbers("Pre-Twist Positions");
  for (std::size_t i = 1; i < std::min(angles.size(), positions.size()); ++i) {
    if (positions[i] != positions[i - 1] || angles[i] == angles[i - 1]) continue;
    issues.add(curve.where("Pre-Twist Positions"),
               fmt::format("'Pre-Twist' jumps at {:g}, and a beam does not; where its sections do, "
                           "they have an 'Angle'",
                           positions[i]));
  }
}

// What all curves share: how the sections stand on them.
Schema curve_schema(std::string type, std::string doc) {
  Schema schema(std::move(type), std::move(doc));
  schema
      .add(direction_field("Up",
                           "Direction that d1 is as near to as the axis allows; by default a "
                           "normal of the curve.")
               .optional())
      .add(numbers("Pre-Twist", "rad", "Angles of d1 about the axis, from where Up puts it.")
               .min_size(1)
               .optional())
      .add(numbers("Pre-Twist Positions", "1",
                   "Places of these angles, 0 at the start and 1 at the end of the axis; linear "
                   "between them.")
               .between(0.0, 1.0)
               .optional())
      .check([](const Options& curve, InputIssues& issues) {
        if (curve.has("Up")) require_direction(curve, "Up", issues);
        if (curve.has("Pre-Twist") != curve.has("Pre-Twist Positions")) {
          issues.add(curve.where(), "'Pre-Twist' and 'Pre-Twist Positions' need each other");
        } else if (curve.has("Pre-Twist")) {
          check_positions(curve, "Pre-Twist Positions", curve.numbers("Pre-Twist").size(), issues);
          check_twist(curve, issues);
        }
      });
  return schema;
}

// A number beyond this is a slip, and would fill the memory before anything else shows it.
constexpr int most_elements = 100'000;

Field elements_field() {
  return integer("Elements", "Number of elements.").between(1, most_elements);
}

std::function<double(double)> read_twist(const Options& options) {
  if (!options.has("Pre-Twist")) return {};
  return [angles = options.numbers("Pre-Twist"),
          positions = options.numbers("Pre-Twist Positions")](double span) {
    const TablePlace at = table_place(positions, span);
    return (1.0 - at.t) * angles[at.first] + at.t * angles[at.second];
  };
}

Axis place(const std::vector<Segment>& segments, const Vec3& normal, const Options& options,
           const Density& density) {
  const Vec3 up = options.has("Up") ? vector(options, "Up") : normal;
  if (const auto span = find_parallel(segments, density.intervals(), up)) {
    throw InputError(
        options.where("Up"),
        fmt::format("must not be parallel to the axis, but is at {:.4g} of its length", *span));
  }
  return place_nodes(segments, density.intervals(), {up, read_twist(options)});
}

void check_circle(const Options& options, InputIssues& issues) {
  require_direction(options, "Axis", issues);
  const Vec3 arm = vector(options, "From") - vector(options, "Centre");
  const Vec3 axis = vector(options, "Axis");
  if (arm.cross(axis).norm() <= 1e-12 * arm.norm() * axis.norm()) {
    issues.add(options.where("From"), "must not lie on the axis");
  }
}

Schema circle_schema(std::string type, std::string doc) {
  Schema schema = curve_schema(std::move(type), std::move(doc));
  schema.add(point_field("Centre", "A point on the axis of rotation."))
      .add(direction_field("Axis", "Direction of the axis of rotation."))
      .add(point_field("From", "Start of the curve."))
      .add(elements_field())
      .check(check_circle);
  return schema;
}

Axis make_circle(const Options& options, double angle, double pitch, const Density& density) {
  const Curve curve = helix(vector(options, "Centre"), vector(options, "Axis"),
                            vector(options, "From"), angle, pitch);
  return place({{curve, options.integer("Elements")}}, curve.normal, options, density);
}

}  // namespace

Schema line_schema() {
  Schema schema = curve_schema("Line", "Straight axis.");
  schema.add(point_field("From", "Start of the line."))
      .add(point_field("To", "End of the line."))
      .add(elements_field())
      .check([](const Options& line, InputIssues& issues) {
        if (vector(line, "From") == vector(line, "To")) {
          issues.add(line.where("To"), "must differ from 'From'");
        }
      });
  return schema;
}

Axis make_line(const Options& options, const Density& density) {
  const Curve curve = line(vector(options, "From"), vector(options, "To"));
  return place({{curve, options.integer("Elements")}}, curve.normal, options, density);
}

Schema arc_schema() {
  Schema schema = circle_schema("Arc", "Circular arc about an axis.");
  schema.add(number("Angle", "rad", "Angle of the arc about the axis; its sign is the direction."))
      .check([](const Options& arc, InputIssues& issues) {
        if (arc.number("Angle") == 0.0) issues.add(arc.where("Angle"), "must not be zero");
      });
  return schema;
}

Axis make_arc(const Options& options, const Density& density) {
  return make_circle(options, options.number("Angle"), 0.0, density);
}

Schema helix_schema() {
  Schema schema = circle_schema("Helix", "Helix about an axis.");
  schema.add(number("Angle", "rad", "Total angle about the axis; its sign is the direction."))
      .add(number("Pitch", "m", "Advance along the axis per turn in positive direction."))
      .check([](const Options& helix, InputIssues& issues) {
        if (helix.number("Angle") == 0.0) issues.add(helix.where("Angle"), "must not be zero");
      });
  return schema;
}

Axis make_helix(const Options& options, const Density& density) {
  return make_circle(options, options.number("Angle"), options.number("Pitch"), density);
}

Schema arc_through_points_schema() {
  Schema schema = curve_schema("Arc Through Points", "Circular arc through three points.");
  schema.add(point_field("From", "Start of the arc."))
      .add(point_field("Through", "A point between the ends."))
      .add(point_field("To", "End of the arc."))
      .add(elements_field())
      .check([](const Options& arc, InputIssues& issues) {
        const Vec3 first = vector(arc, "Through") - vector(arc, "From");
        const Vec3 second = vector(arc, "To") - vector(arc, "Through");
        if (first.cross(second).norm() <= 1e-9 * first.norm() * second.norm()) {
          issues.add(arc.where("Through"), "must not lie on a line with the ends");
        }
      });
  return schema;
}

Axis make_arc_through_points(const Options& options, const Density& density) {
  const Curve curve =
      arc_through(vector(options, "From"), vector(options, "Through"), vector(options, "To"));
  return place({{curve, options.integer("Elements")}}, curve.normal, options, density);
}

namespace {

std::vector<Vec3> read_points(const Options& options) {
  const auto& values = options.numbers("Points");
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    points.emplace_back(values[i], values[i + 1], values[i + 2]);
  }
  return points;
}

void check_spline(const Options& options, InputIssues& issues) {
  const std::vector<Vec3> points = read_points(options);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] == points[i - 1]) {
      issues.add(options.where("Points"), fmt::format("points {} and {} are the same", i, i + 1));
    }
  }
  if (points.size() > 2 && points.front() == points.back() && !options.has("Up")) {
    issues.add(options.where(), "the curve is closed: give 'Up'");
  }
}

void check_polyline(const Options& options, InputIssues& issues) {
  const std::vector<Vec3> points = read_points(options);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] == points[i - 1]) {
      issues.add(options.where("Points"), fmt::format("points {} and {} are the same", i, i + 1));
    } else if (i > 1) {
      const Vec3 before = (points[i - 1] - points[i - 2]).normalized();
      if (before.dot((points[i] - points[i - 1]).normalized()) < -1.0 + 1e-12) {
        issues.add(options.where("Points"), fmt::format("the line turns back at point {}", i));
      }
    }
  }
  const std::size_t counts = options.integers("Elements").size();
  if (counts != 1 && counts != points.size() - 1) {
    issues.add(options.where("Elements"),
               fmt::format("must have one number, or one per segment: {} segments, {} numbers",
                           points.size() - 1, counts));
  }
}

// The normal of the plane of all points; that of the first line if they are all on one.
Vec3 plane_normal(const std::vector<Segment>& segments, const Options& options) {
  const Vec3 first = segments.front().curve.tangent(0.0);
  Vec3 normal = Vec3::Zero();
  for (const Segment& segment : segments) {
    const Vec3 tangent = segment.curve.tangent(0.0);
    if (normal.isZero(0.0)) {
      const Vec3 product = first.cross(tangent);
      if (product.norm() > 1e-9) normal = product.normalized();
    } else if (std::abs(normal.dot(tangent)) > 1e-9) {
      throw InputError(options.where(), "the points are not in a plane: give 'Up'");
    }
  }
  return normal.isZero(0.0) ? segments.front().curve.normal : normal;
}

}  // namespace

Schema spline_schema() {
  Schema schema = curve_schema("Spline", "Smooth curve, a natural cubic spline through points.");
  schema
      .add(numbers("Points", "m", "Points from start to end, three coordinates each.")
               .size_multiple_of(3)
               .min_size(6))
      .add(elements_field())
      .check(check_spline);
  return schema;
}

Axis make_spline(const Options& options, const Density& density) {
  const Curve curve = spline(read_points(options));
  return place({{curve, options.integer("Elements")}}, curve.normal, options, density);
}

Schema polyline_schema() {
  Schema schema = curve_schema(
      "Polyline", "Straight segments; at a kink the two end nodes are linked rigidly.");
  schema
      .add(numbers("Points", "m", "Corners from start to end, three coordinates each.")
               .size_multiple_of(3)
               .min_size(6))
      .add(integers("Elements", "Number of elements of each segment; one number serves all.")
               .between(1, most_elements)
               .min_size(1))
      .check(check_polyline);
  return schema;
}

Axis make_polyline(const Options& options, const Density& density) {
  const std::vector<Vec3> points = read_points(options);
  const std::vector<int>& elements = options.integers("Elements");
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    segments.push_back(
        {line(points[i], points[i + 1]), elements.size() == 1 ? elements[0] : elements[i]});
  }
  const Vec3 normal = options.has("Up") ? Vec3::Zero() : plane_normal(segments, options);
  return place(segments, normal, options, density);
}

}  // namespace culm::beam
