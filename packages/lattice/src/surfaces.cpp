#include "surfaces.hpp"

#include <algorithm>

namespace culm::lattice {
namespace {

bool has_tip(const Options& options, const char* end) {
  const auto& tips = options.texts("Tips");
  return std::ranges::find(tips, end) != tips.end();
}

// Equal panels; the lattice ends a quarter of a panel before a free tip. As fractions of the
// length.
std::vector<double> stations_of(const Options& options) {
  const int n = panels_of(options).span;
  const double first = has_tip(options, "first") ? 0.25 : 0.0;
  const double last = has_tip(options, "last") ? 0.25 : 0.0;
  std::vector<double> stations;
  for (int j = 0; j <= n; ++j) stations.push_back((j + first) / (n + first + last));
  return stations;
}

}  // namespace

Panels panels_of(const Options& options) {
  const auto& panels = options.integers("Panels");
  return {panels[0], panels[1]};
}

Schema surface_schema() {
  return Schema("Surface", "A lifting surface on a beam or a shell.")
      .add(model::structure_field())
      .add(integers("Panels", "Along the chord, and along the span.").size(2).at_least(1))
      .add(texts("Tips",
                 "Ends of the span that are free: the lattice ends a quarter of a panel before "
                 "them. Not those that meet the mirror or another surface.")
               .one_of({"first", "last"})
               .optional({"last"}))
      .add(number("Chord", "m", "On a beam: of the surface, constant along the span.")
               .positive()
               .optional())
      .add(numbers("Chords", "m", "On a beam: at Positions, linear between them.")
               .positive()
               .optional())
      .add(numbers("Positions", "1", "Where Chords are, as fractions of the length.")
               .between(0.0, 1.0)
               .optional())
      .add(numbers("Nose", "1",
                   "On a beam: direction from its axis to the leading edge, along the first two "
                   "directors.")
               .size(2)
               .optional({-1.0, 0.0}))
      .add(number("Axis At", "1", "On a beam: its axis behind the leading edge, in chords.")
               .optional(0.25))
      .add(number("Camber", "1",
                  "On a beam: height of the parabolic mean line over the chord, towards the side "
                  "that chord x span points to.")
               .optional(0.0))
      .add(text("Leading Edge", "On a shell: name of its edge against the flow.").optional())
      .add(text("Trailing Edge", "On a shell: name of its edge where the wake begins.").optional());
}

std::optional<SurfaceGrid> read_surface(const Options& options, model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return {};
  const std::vector<double> stations = stations_of(options);
  if (!structure->line_points.empty()) {
    return beam_surface(options, *structure, stations, context);
  }
  if (!structure->faces.empty()) return shell_surface(options, *structure, stations, context);
  context.issues.add(options.where("Structure"),
                     "structure '" + structure->name + "' is neither a beam nor a shell");
  return {};
}

}  // namespace culm::lattice
