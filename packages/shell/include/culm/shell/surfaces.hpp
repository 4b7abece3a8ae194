/// Structured patches of shell elements on simple surfaces.
#pragma once

#include <culm/shell/shell_mesh.hpp>

#include <functional>
#include <string>
#include <vector>

namespace culm::shell {

/// A surface over (u, v) in [0, 1]^2 with its normal along ∂x/∂u x ∂x/∂v, length one.
struct Surface {
  std::function<Vec3(double u, double v)> point;
  std::function<Vec3(double u, double v)> normal;
};

/// A plane curve over s in [0, 1].
using PlaneCurve = std::function<Vec<2>(double s)>;

/// Angles of a surface of revolution about z, from x towards y [rad].
struct Sweep {
  double from = 0.0;
  double to = 6.283185307179586;
};

/// The parallelogram origin, origin + u side1 + v side2.
Surface plane(const Vec3& origin, const Vec3& side1, const Vec3& side2);
/// Radius about z, z from 0 to length; u around, v along; normal outward. A full sweep is a tube.
Surface cylinder(double radius, double length, Sweep sweep = {});
/// Latitudes from the equator [rad], inside (-π/2, π/2); u around, v up; normal outward.
Surface sphere(double radius, double latitude_from, double latitude_to, Sweep sweep = {});
/// Radii at z = 0 and z = height; u around, v up; normal outward.
Surface cone(double radius_below, double radius_above, double height, Sweep sweep = {});
/// In the plane z = 0; u outward, v around; normal z.
Surface annulus(double inner_radius, double outer_radius, Sweep sweep = {});
/// z = rise (x^2 - y^2) over the square |x|, |y| <= side / 2. @param rise [1/m]
Surface hypar(double side, double rise);
/// A strip along x, of this width across, that turns about x by `twist` [rad] from y towards z;
/// u along x, v across; normal z at the start.
Surface twisted_strip(double length, double width, double twist);
/// A curve of the plane z = 0 drawn along z; u along the curve, v along z; normal to the right of
/// the curve, hence outward if it runs counter-clockwise.
Surface extrusion(PlaneCurve curve, double length);

/// nu x nv elements, each divided into refinement x refinement. Edges `NAME u0`, `NAME u1`, `NAME
/// v0`, `NAME v1` are the four sides; the part NAME has all elements.
Facets patch(const Surface& surface, int nu, int nv, const std::string& name, int refinement = 1);

/// Measures of an I-section: flanges across x at y = ± height / 2, web along y between them [m].
struct ISection {
  double height;
  double top_width;
  double bottom_width;
};
/// An I-section along z. Parts `web`, `top left`, `top right`, `bottom left`, `bottom right`;
/// `start` and `end` are the edges of all at z = 0 and z = length.
/// @param flange, web, along  elements over half a flange, the web, the length
Facets i_section(const ISection& section, double length, int flange, int web, int along,
                 int refinement = 1);

/// The symmetric NACA four-digit profile with closed trailing edge, counter-clockwise from there
/// over the upper side; chord along x from the nose at 0. s is linear in the
/// root of x, so that equal parts are finest at the nose.
/// @param thickness  largest, as a fraction of the chord
PlaneCurve naca_profile(double chord, double thickness);
/// That profile drawn along z, with webs at fractions of the chord, ascending, in (0, 1). Parts
/// `skin`, `web 1`, ...; edges `start` and `end` are those of all at z = 0 and z = length.
/// @param around  elements around the skin, about; at least one between webs
/// @param across  elements over the height of each web
Facets airfoil(double chord, double thickness, double length, const std::vector<double>& webs,
               int around, int across, int along, int refinement = 1);

}  // namespace culm::shell
