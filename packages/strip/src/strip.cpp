#include <culm/base/nearest.hpp>
#include <culm/strip/register_strip.hpp>

#include "places.hpp"
#include "types.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace culm::strip {
namespace {

constexpr double three_quarters = 0.75;

void check_strip(const Options& options, InputIssues& issues) {
  check_places(options, {"Chords", "Twists", "Axes At", "Airfoils"}, issues);
  check_one_of("Chord", "Chords", options, issues);
  check_one_of("Airfoil", "Airfoils", options, issues);
  const std::string& lag = options.text("Lag");
  if ((lag == "Airfoil" || lag == "Four States") && options.flag("Apparent Mass")) {
    issues.add(
        options.where("Lag"),
        "constants of airfoils stand for apparent mass, too: take 'Apparent Mass' = false, or "
        "'Lag' = Jones");
  }
  if (options.number("Angle At") != three_quarters &&
      (lag == "Jones" || options.flag("Apparent Mass"))) {
    issues.add(options.where("Angle At"),
               "must be 0.75 with 'Lag' = Jones and with 'Apparent Mass', which belong to the "
               "angle at the three-quarter chord");
  }
  if (Vec<2>(options.numbers("Nose").data()).norm() < 1e-12) {
    issues.add(options.where("Nose"), "must not be zero");
  }
}

Schema strip_schema() {
  Schema schema(
      "Strip",
      "Lift, drag and moment of a flow on sections of a beam, or of a node that stands for a "
      "piece of a wing, by coefficients of airfoils.");
  add_place_fields(schema);
  return schema.add(number("Chord", "m", "Chord, the same everywhere.").positive().optional())
      .add(numbers("Chords", "m", "Chords at the positions, linear in between.")
               .positive()
               .optional())
      .add(
          number("Twist", "rad", "Turn of the chord about the axis, nose towards the suction side.")
              .optional(0.0))
      .add(numbers("Twists", "rad", "The same at the positions.").optional())
      .add(number("Axis At", "1", "Place of the axis behind the nose, in chords.").optional(0.25))
      .add(numbers("Axes At", "1", "The same at the positions.").optional())
      .add(number("Angle At", "1",
                  "Place behind the nose, in chords, whose wind has the angle of attack and the "
                  "speed that count: three quarters, as in the theory of thin airfoils, where a "
                  "section that turns about its span meets another angle; a quarter, as programs "
                  "do that leave this out.")
               .between(0.0, 1.0)
               .optional(three_quarters))
      .add(numbers("Nose", "1", "Direction from the axis to the nose, along the directors 1 and 2.")
               .size(2)
               .optional(std::vector<double>{-1.0, 0.0}))
      .add(numbers(
               "Suction", "1",
               "Side of positive lift, along the directors 1 and 2; if absent, a quarter turn from "
               "the direction of the tail, from director 1 to director 2.")
               .size(2)
               .optional())
      .add(text("Airfoil", "Airfoil, the same everywhere.").optional())
      .add(texts("Airfoils", "Airfoils at the positions; coefficients are linear in between.")
               .optional())
      .add(choice(
               "Lag", {"None", "Jones", "Airfoil", "Oye", "Four States"},
               "Lag of the circulation: none, of a thin airfoil, or with the constants of airfoil "
               "files. Or dynamic stall, of polars: Oye, where the attached share of the chord "
               "follows; Four States, the lag of airfoil files, pressure and attached share.")
               .optional("Jones"))
      .add(flag("Apparent Mass", "Whether the fluid that moves with the section has inertia.")
               .optional(true))
      .check(check_strip);
}

SharedAirfoil find_airfoil(const std::string& name, const Where& where, StripContext& context) {
  if (const auto found = context.airfoils.find(name); found != context.airfoils.end()) {
    return found->second;
  }
  std::vector<std::string> names;
  for (const auto& [known, airfoil] : context.airfoils) names.push_back(known);
  context.fluids.build.issues.add(where,
                                  "unknown airfoil '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

std::vector<SharedAirfoil> find_airfoils(const Options& options, StripContext& context) {
  std::vector<SharedAirfoil> airfoils;
  const char* parameter = options.has("Airfoils") ? "Airfoils" : "Airfoil";
  const std::vector<std::string> names =
      options.has("Airfoils") ? options.texts("Airfoils") : std::vector{options.text("Airfoil")};
  for (const std::string& name : names) {
    airfoils.push_back(find_airfoil(name, options.where(parameter), context));
    if (airfoils.back() == nullptr) return {};
  }
  return airfoils;
}

StripModel model_of(const Options& options) {
  StripModel model;
  const std::string& lag = options.text("Lag");
  if (lag == "Jones") model.lag = Lag::jones();
  if (lag == "Airfoil" || lag == "Four States") model.lag = Lag::airfoil();
  if (lag == "Oye") model.stall = Stall::oye;
  if (lag == "Four States") model.stall = Stall::four_states;
  model.apparent_mass = options.flag("Apparent Mass");
  return model;
}

bool can_stall(const std::vector<SharedAirfoil>& airfoils) {
  return std::ranges::any_of(
      airfoils, [](const SharedAirfoil& airfoil) { return airfoil->separation() != nullptr; });
}

void make_strip(const Options& options, StripContext& context) {
  model::BuildContext& build = context.fluids.build;
  const flow::SharedFlow flow = find_wind(options, context);
  const auto function = find_time_function(options, build);
  const std::vector<SharedAirfoil> airfoils = find_airfoils(options, context);
  const std::vector<Place> places = places_of(options, build);
  if (!flow || !function || airfoils.empty() || places.empty()) return;
  const StripModel model = model_of(options);
  if (model.stall != Stall::none && !can_stall(airfoils)) {
    build.issues.add(options.where("Lag"),
                     "is a model of stall, but no airfoil of '" + options.name() +
                         "' can stall: it needs a polar whose lift rises through zero");
    return;
  }
  const Distribution chord(options, "Chord", "Chords"), twist(options, "Twist", "Twists"),
      axis_at(options, "Axis At", "Axes At");
  const Vec<2> nose = Vec<2>(options.numbers("Nose").data()).normalized();
  const Vec3 tail(-nose[0], -nose[1], 0.0);
  Vec3 suction = Vec3::UnitZ().cross(tail);
  if (options.has("Suction")) {
    const Vec<2> side(options.numbers("Suction").data());
    const double sine = side.dot(suction.head<2>());
    if (std::abs(sine) < 1e-6 * side.norm() || side.norm() == 0.0) {
      build.issues.add(options.where("Suction"), "must not be along the chord");
      return;
    }
    if (sine < 0.0) suction = -suction;
  }
  auto load = std::make_unique<StripLoad>(model::Effect("Strip", options.name()),
                                          build.model.nodes(), *function, flow, model);
  for (const Place& place : places) {
    Station station{place.point, place.length, chord.at(place.s), axis_at.at(place.s)};
    const double turn = twist.at(place.s);
    station.along = std::cos(turn) * tail - std::sin(turn) * suction;
    station.across = std::cos(turn) * suction + std::sin(turn) * tail;
    const Between between =
        airfoils.size() > 1 ? find_between(options.numbers("Positions"), place.s) : Between{};
    station.angle_at = options.number("Angle At");
    station.airfoil = airfoils[between.index];
    station.blend = between.share;
    station.next_airfoil = airfoils[std::min(between.index + 1, airfoils.size() - 1)];
    load->add(std::move(station));
  }
  context.strips.emplace(options.name(), load.get());
  add_strips(options, std::move(load), context);
}

}  // namespace

void register_strips(StripRegistry& registry) {
  registry.add("Strip", strip_schema(), make_strip);
  register_strip_drag(registry);
}

}  // namespace culm::strip
