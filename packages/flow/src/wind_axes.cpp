#include "wind_axes.hpp"

#include <culm/model/build_context.hpp>

#include <cmath>

namespace culm::flow {

Vec3 WindAxes::turned(double angle) const {
  const Vec3 vertical = along.dot(up) * up;
  return vertical + std::cos(angle) * (along - vertical) +
         std::sin(angle) * (along - vertical).cross(up);
}

Schema wind_axes_schema() {
  return Schema("Wind", "")
      .add(model::vector_field("Direction", "1", "Where the mean wind blows to, of any length.")
               .optional({1.0, 0.0, 0.0}))
      .add(model::vector_field("Up", "1", "Away from the ground, of any length.")
               .optional({0.0, 0.0, 1.0}))
      .check([](const Options& options, InputIssues& issues) {
        const Vec3 direction = model::vector(options, "Direction");
        const Vec3 up = model::vector(options, "Up");
        if (direction.cross(up).norm() > 1e-6 * direction.norm() * up.norm()) return;
        issues.add(options.where("Direction"), "'Direction' and 'Up' must not be parallel or zero");
      });
}

WindAxes read_wind_axes(const Options& options) {
  WindAxes axes;
  axes.along = model::vector(options, "Direction").normalized();
  axes.up = model::vector(options, "Up").normalized();
  axes.across = axes.up.cross(axes.along).normalized();
  axes.normal = axes.along.cross(axes.across);
  return axes;
}

}  // namespace culm::flow
