#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "face.hpp"
#include "face_points.hpp"
#include "types.hpp"

#include <Eigen/Geometry>

namespace culm::load {
namespace {

// Two by two points per face, each with the share of the reference area around it.
void build_surface_force(const Options& options, model::BuildContext& context) {
  const auto function = model::find_function(options, context);
  const auto faces = loaded_faces(options, context);
  if (!function || faces.empty()) return;
  const model::NodeTable& nodes = context.model.nodes();
  const Vec3 force = model::vector(options, "Force");
  auto load = std::make_unique<SlotLoad>(effect_of("Surface Force", options), nodes, *function);
  for (const LoadedFace& face : faces) {
    Mat<3, 16> q;
    for (int a = 0; a < 4; ++a) {
      q.middleCols<4>(4 * a) =
          model::NodeTable::slots(nodes.reference(), face.nodes[static_cast<std::size_t>(a)]);
    }
    const Mat<3, 4> X = corners(q, face.zeta);
    for (const FacePoint& point : face_points()) {
      const Vec3 normal = (X * point.N_xi).cross(X * point.N_eta);
      const model::Marker marker{{face.nodes.begin(), face.nodes.end()},
                                 {point.N.begin(), point.N.end()},
                                 face.zeta * Vec3::UnitX()};
      load->add_force(marker, normal.norm() * force, Axes::space);
    }
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_surface_force(model::BuilderRegistry& registry) {
  Schema schema("Surface Force", "Force per reference area of a shell, fixed in space.");
  schema.add_all(face_fields())
      .add(model::vector_field("Force", "N/m^2", "Components in space at function value 1."))
      .add(model::function_field("Ramp"));
  registry.add("Surface Force", schema, build_surface_force);
}

}  // namespace culm::load
