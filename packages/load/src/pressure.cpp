#include <culm/load/pressure_load.hpp>

#include "both_frames.hpp"
#include "face.hpp"
#include "types.hpp"

namespace culm::load {
namespace {

void build_pressure(const Options& options, model::BuildContext& context) {
  const auto function = model::find_function(options, context);
  const auto faces = loaded_faces(options, context);
  if (!function || faces.empty()) return;
  auto load = std::make_unique<PressureLoad>(effect_of("Pressure", options), context.model.nodes(),
                                             *function);
  for (const LoadedFace& face : faces) {
    load->add_face(face.nodes, face.zeta, options.number("Pressure"));
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_pressure(model::BuilderRegistry& registry) {
  Schema schema("Pressure", "Pressure normal to a shell, following it, on its current area.");
  schema.add_all(face_fields())
      .add(number("Pressure", "Pa",
                  "At function value 1; positive along the directors, hence outwards from Bottom "
                  "to Top, on every face."))
      .add(model::function_field("Ramp"));
  registry.add("Pressure", schema, build_pressure);
}

}  // namespace culm::load
