#include "places.hpp"
#include "types.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace culm::strip {
namespace {

// No lift and no moment, from whatever side the wind comes.
class Bluff final : public Airfoil {
 public:
  explicit Bluff(double drag) : drag_(drag) {}
  Coefficients at(double, Coefficients& slope) const override {
    slope.setZero();
    return {0.0, drag_, 0.0};
  }

 private:
  double drag_;
};

Schema drag_schema() {
  Schema schema("Strip Drag",
                "Drag of a flow across a beam, or across a node that stands for a piece of one, in "
                "the direction of the wind that it meets there: towers, masts, nacelles, cables.");
  add_place_fields(schema);
  return schema
      .add(number("Diameter", "m", "Width across the wind, the same everywhere.")
               .positive()
               .optional())
      .add(numbers("Diameters", "m", "Widths at the positions, linear in between.")
               .positive()
               .optional())
      .add(number("Drag", "1", "Coefficient of drag, of the width and the speed across the axis.")
               .at_least(0.0)
               .optional(1.0))
      .add(numbers("Drags", "1", "The same at the positions.").at_least(0.0).optional())
      .check([](const Options& options, InputIssues& issues) {
        check_places(options, {"Diameters", "Drags"}, issues);
        check_one_of("Diameter", "Diameters", options, issues);
      });
}

// Force and wind are those of the axis, so no direction in the section is a special one.
void make_strip_drag(const Options& options, StripContext& context) {
  model::BuildContext& build = context.fluids.build;
  flow::SharedFlow flow = flow::find_flow(options, context.fluids);
  const auto function = find_time_function(options, build);
  const std::vector<Place> places = places_of(options, build);
  if (!flow || !function || places.empty()) return;
  const Distribution diameter(options, "Diameter", "Diameters"), drag(options, "Drag", "Drags");
  // coefficients of a tower, and of what stands on it, are those of the wind that comes
  if (flow::SharedFlow alone = flow->without_structure()) flow = std::move(alone);
  auto load = std::make_unique<StripLoad>(model::Effect("Strip Drag", options.name()),
                                          build.model.nodes(), *function, flow, StripModel{});
  for (const Place& place : places) {
    Station station{place.point, place.length, diameter.at(place.s), 0.5};
    station.along = Vec3::UnitX();
    station.across = Vec3::UnitY();
    station.airfoil = station.next_airfoil = std::make_shared<Bluff>(drag.at(place.s));
    station.force_at = station.angle_at = 0.5;
    load->add(std::move(station));
  }
  add_strips(options, std::move(load), context);
}

}  // namespace

void register_strip_drag(StripRegistry& registry) {
  registry.add("Strip Drag", drag_schema(), make_strip_drag);
}

}  // namespace culm::strip
