#include <culm/base/nearest.hpp>
#include <culm/joint/triad_nodes.hpp>
#include <culm/strip/register_strip.hpp>
#include <culm/strip/shared_chord.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::strip {
namespace {

// A place on the table of positions: between entry `index` and the next one.
struct Between {
  std::size_t index = 0;
  double share = 0.0;
};

Between find(const std::vector<double>& positions, double s) {
  const auto above = std::upper_bound(positions.begin() + 1, positions.end() - 1, s);
  const auto index = static_cast<std::size_t>(above - positions.begin()) - 1;
  const double length = positions[index + 1] - positions[index];
  const double share = length > 0.0 ? (s - positions[index]) / length : 1.0;
  return {index, std::clamp(share, 0.0, 1.0)};
}

// What may vary along the span: one value, or one at each of the positions.
class Distribution {
 public:
  Distribution(const Options& options, const char* one, const char* several) {
    if (options.has(several)) {
      values_ = options.numbers(several);
      positions_ = options.numbers("Positions");
    } else {
      values_ = {options.number(one)};
    }
  }
  double at(double s) const {
    if (values_.size() == 1) return values_.front();
    const Between place = find(positions_, s);
    return (1.0 - place.share) * values_[place.index] + place.share * values_[place.index + 1];
  }

 private:
  std::vector<double> values_, positions_;
};

constexpr const char* tables[] = {"Chords", "Twists", "Axes At", "Airfoils"};

void check_tables(const Options& options, InputIssues& issues) {
  bool any = false;
  for (const char* table : tables) any = any || options.has(table);
  if (any != options.has("Positions")) {
    issues.add(options.where(),
               any ? "'Chords', 'Twists', 'Axes At' and 'Airfoils' need 'Positions'"
                   : "'Positions' needs 'Chords', 'Twists', 'Axes At' or 'Airfoils'");
    return;
  }
  if (!any) return;
  const std::vector<double>& positions = options.numbers("Positions");
  if (positions.front() != 0.0 || positions.back() != 1.0 ||
      !std::is_sorted(positions.begin(), positions.end())) {
    issues.add(options.where("Positions"),
               "must rise from 0 to 1, as fractions of the length of the line");
  }
  for (const char* table : tables) {
    if (!options.has(table)) continue;
    const std::size_t count = std::string(table) == "Airfoils" ? options.texts(table).size()
                                                               : options.numbers(table).size();
    if (count == positions.size()) continue;
    issues.add(options.where(table),
               fmt::format("must have one value for each of {} positions, got {}", positions.size(),
                           count));
  }
}

void check_one_of(const char* one, const char* several, const Options& options,
                  InputIssues& issues) {
  if (options.has(one) != options.has(several)) return;
  issues.add(options.where(), fmt::format("give one of '{}' and '{}'", one, several));
}

void check(const Options& options, InputIssues& issues) {
  check_one_of("Structure", "Node", options, issues);
  if (options.has("Node") != options.has("Length")) {
    issues.add(options.where(), "'Node' and 'Length' need each other");
  }
  check_one_of("Chord", "Chords", options, issues);
  check_one_of("Airfoil", "Airfoils", options, issues);
  check_tables(options, issues);
  const std::string& lag = options.text("Lag");
  if ((lag == "Airfoil" || lag == "Four States") && options.flag("Apparent Mass")) {
    issues.add(
        options.where("Lag"),
        "constants of airfoils stand for apparent mass, too: take 'Apparent Mass' = false, or "
        "'Lag' = Jones");
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
  return schema.add(text("Structure", "The beam that it acts on.").optional())
      .add(text("Node", "A node, instead, whose third director is the span.").optional())
      .add(number("Length", "m", "Span that the node stands for.").positive().optional())
      .add(flow::flow_field())
      .add(model::function_field("Constant"))
      .add(integer("Stations", "Sections at which the flow acts, each in the middle of its part.")
               .between(1, 100000)
               .optional(20))
      .add(numbers("Positions", "1",
                   "Fractions of the length at which the lists below have their values.")
               .min_size(2)
               .optional())
      .add(number("Chord", "m", "Chord, the same everywhere.").positive().optional())
      .add(numbers("Chords", "m", "Chords at the positions, linear in between.")
               .positive()
               .optional())
      .add(
          number("Twist", "rad", "Turn of the chord about the axis, nose towards the suction side.")
              .optional(0.0))
      .add(numbers("Twists", "rad", "The same at the positions.").optional())
      .add(number("Axis At", "1", "Place of the axis behind the nose, in chords.").optional(0.25))
      .add(numbers("Axes At", "1", "The same at the positions.").optional())
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
      .check(check);
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

// Axis points of all stations, each with its fraction of the length.
struct Place {
  model::Marker point;
  double length = 0.0;
  double s = 0.0;
};

std::vector<Place> places_on_line(const Options& options, model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return {};
  const int count = options.integer("Stations");
  double length = 0.0;
  for (const model::LinePoint& point : structure->line_points) length += point.length;
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5) / count;
    const auto point = model::marker_at_fraction(*structure, s);
    if (!point) {
      context.issues.add(options.where("Structure"),
                         "structure '" + structure->name + "' is not a line: it has no span");
      return {};
    }
    places.push_back({*point, length / count, s});
  }
  if (!joint::have_triads(places.front().point.nodes, "Structure", options, context)) return {};
  return places;
}

std::vector<Place> places_of(const Options& options, model::BuildContext& context) {
  if (options.has("Structure")) return places_on_line(options, context);
  std::vector<Place> places;
  const std::vector<int> nodes = model::select_nodes(options, "Node", context);
  if (!joint::have_triads(nodes, "Node", options, context)) return {};
  for (const int node : nodes) {
    places.push_back({model::marker_at(node), options.number("Length"), 0.5});
  }
  return places;
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

// One chord takes one load of the air; loads with functions may take turns, which a run looks at.
void refuse_second_load(const Options& options, const StripLoad& load, StripContext& context) {
  if (!load.amplitude().is_constant()) return;
  model::BuildContext& build = context.fluids.build;
  for (const auto& [name, other] : context.strips) {
    if (!other->amplitude().is_constant() || !count_twice(load, *other, {}, Stencil::statics()) ||
        !share_chord(load, *other, build.model)) {
      continue;
    }
    const char* on = options.has("Structure") ? "Structure" : "Node";
    build.issues.add(options.where(on), "'" + options.text(on) + "' has the strips '" + name +
                                            "' in the same place: the air would act on it twice");
    return;
  }
}

void make(const Options& options, StripContext& context) {
  model::BuildContext& build = context.fluids.build;
  flow::SharedFlow flow = flow::find_flow(options, context.fluids);
  if (flow && options.has("Structure")) {
    if (auto bare = flow->undisturbed_by(options.text("Structure"))) flow = std::move(bare);
  }
  const auto function = model::find_function(options, build);
  const std::vector<SharedAirfoil> airfoils = find_airfoils(options, context);
  const std::vector<Place> places = places_of(options, build);
  if (!flow || !function || airfoils.empty() || places.empty()) return;
  if (function->signal() != nullptr) {
    build.issues.add(options.where("Function"), "must be a function of time, not a signal");
    return;
  }
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
        airfoils.size() > 1 ? find(options.numbers("Positions"), place.s) : Between{};
    station.airfoil = airfoils[between.index];
    station.blend = between.share;
    station.next_airfoil = airfoils[std::min(between.index + 1, airfoils.size() - 1)];
    load->add(std::move(station));
  }
  refuse_second_load(options, *load, context);
  context.strips.emplace(options.name(), load.get());
  build.model.add_load(std::move(load));
}

}  // namespace

void register_strips(StripRegistry& registry) { registry.add("Strip", strip_schema(), make); }

}  // namespace culm::strip
