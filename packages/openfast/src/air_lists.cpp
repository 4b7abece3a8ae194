#include "air_lists.hpp"

#include "blade_axis.hpp"
#include "headings.hpp"
#include "sea_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::openfast {

namespace {

constexpr int blade_stations = 30;
constexpr int tower_stations = 10;
constexpr double time_step = 0.02;  // [s]
// a quarter chord may be so far beside the chord line through the axis of the beam, in chords
constexpr double beside = 0.01;

std::string blade_name(std::size_t i) { return fmt::format("blade {}", i + 1); }
std::string load_name(std::size_t i) { return "air on " + blade_name(i); }
constexpr const char* tower_load = "air on the tower";

std::string times_speed(const Vec3& direction) {
  const auto item = [](double value) {
    return value == 0.0 ? std::string("0") : fmt::format("{:.12g}*W", value);
  };
  return fmt::format("{{{}, {}, {}}}", item(direction.x()), item(direction.y()),
                     item(direction.z()));
}

double linear(const std::vector<double>& places, const std::vector<double>& values, double at) {
  const auto above = std::upper_bound(places.begin() + 1, places.end() - 1, at);
  const auto i = static_cast<std::size_t>(above - places.begin());
  const double share = std::clamp((at - places[i - 1]) / (places[i] - places[i - 1]), 0.0, 1.0);
  return (1.0 - share) * values[i - 1] + share * values[i];
}

// Of values along the tower.
double mean(const std::vector<AeroTowerStation>& shape, double AeroTowerStation::*value) {
  double sum = 0.0;
  for (const AeroTowerStation& station : shape) sum += station.*value;
  return sum / static_cast<double>(shape.size());
}

void write_tower_influence(const ElastoDyn& turbine, Report& report, DeckWriter& deck) {
  const AeroTowerInfluence& influence = *turbine.air->loads.tower_influence;
  std::vector<double> heights, diameters;
  for (const AeroTowerStation& station : influence.shape) {
    heights.push_back(station.height);
    diameters.push_back(station.diameter);
  }
  const double drag = mean(influence.shape, &AeroTowerStation::drag);
  const double turbulence = mean(influence.shape, &AeroTowerStation::turbulence);
  deck.open("Tower Influence");
  deck.set("Structure", "tower");
  deck.set("Diameters", std::vector<double>{linear(heights, diameters, turbine.tower_base),
                                            linear(heights, diameters, turbine.tower_top)});
  deck.set("Upstream", influence.upstream);
  deck.set("Downstream", influence.downstream);
  deck.set("Drag", drag);
  deck.set("Turbulence", turbulence);
  deck.close();
  report.add(
      assumed,
      fmt::format("influence of the tower: diameters linear between foot and top, the mean drag "
                  "{:g} and turbulence {:g} of the file, about the tower in its reference",
                  drag, turbulence));
}

const char* type_of(Wind::Kind kind) {
  switch (kind) {
    case Wind::Kind::table:
      return "Table";
    case Wind::Kind::box:
      return "TurbSim Box";
    case Wind::Kind::mann:
      return "Mann Box";
    case Wind::Kind::bladed:
      return "Bladed Box";
    default:
      return "Power Law";
  }
}

bool is_box(const Wind& wind) {
  using Kind = Wind::Kind;
  return wind.kind == Kind::box || wind.kind == Kind::mann || wind.kind == Kind::bladed;
}

// Whether a box repeats itself, so that it can be anywhere at the start; as OpenFAST does.
bool is_endless(const Wind& wind) {
  using Kind = Wind::Kind;
  return wind.kind == Kind::mann || (wind.kind == Kind::bladed && wind.bladed.is_periodic);
}

// Whether there is a mean wind by a law of the height.
bool has_mean(const Wind& wind) {
  using Kind = Wind::Kind;
  return wind.kind == Kind::power_law || wind.kind == Kind::mann ||
         (wind.kind == Kind::bladed && wind.speed > 0.0);
}

void write_mann(const MannFiles& box, const std::filesystem::path& folder, DeckWriter& deck) {
  std::vector<std::string> names;
  for (const auto& file : box.files) names.push_back(name_from(folder, file));
  deck.set("File Names", names);
  deck.set("Points", std::vector<double>(box.points.begin(), box.points.end()));
  deck.set("Spacing", box.spacing);
  if (!box.factors.empty()) deck.set("Factors", box.factors);
  if (!box.deviations.empty()) deck.set("Deviations", box.deviations);
  if (box.loses_means) deck.set("Without Means", "true");
}

void write_bladed(const BladedFile& box, DeckWriter& deck) {
  if (!box.intensities.empty()) deck.set("Intensities", box.intensities);
  deck.set("Components Across", box.is_left_handed ? "Right" : "Left");
  deck.set("Points From", box.is_clockwise ? "Left" : "Right");
  deck.set("Periodic", box.is_periodic ? "true" : "false");
}

void write_flow(const ElastoDyn& turbine, const std::filesystem::path& folder, Report& report,
                DeckWriter& deck) {
  const Air& air = *turbine.air;
  const Wind& wind = air.wind;
  using Kind = Wind::Kind;
  deck.open("wind", type_of(wind.kind));
  deck.set("Density", air.loads.density);
  if (has_mean(wind)) {
    deck.set("Speed", "V");
    deck.set("Height", wind.height);
    if (wind.roughness > 0.0) {
      deck.set("Roughness", wind.roughness);
    } else {
      deck.set("Exponent", wind.exponent);
    }
  }
  if (!wind.file.empty()) deck.set("File Name", name_from(folder, wind.file));
  if (wind.kind == Kind::table) {
    deck.set("File Format", "OpenFAST");
    deck.set("Height", wind.height);
    deck.set("Length", wind.length);
  }
  if (wind.kind == Kind::mann) write_mann(wind.mann, folder, deck);
  if (wind.kind == Kind::bladed) write_bladed(wind.bladed, deck);
  if (is_box(wind)) {
    deck.set("Centre", Vec3(0.0, 0.0, wind.centre));
    if (is_endless(wind)) deck.set("Delay", has_mean(wind) ? wind.ahead / wind.speed : 0.0);
    deck.set("Outside", "Hold");
  }
  deck.set("Direction",
           Vec3(std::cos(wind.upflow) * std::cos(wind.direction),
                -std::cos(wind.upflow) * std::sin(wind.direction), std::sin(wind.upflow)));
  if (air.loads.tower_influence) write_tower_influence(turbine, report, deck);
  deck.close();
}

void write_polar(const std::string& name, const std::vector<AirfoilRow>& rows, bool has_moments,
                 DeckWriter& deck) {
  std::vector<double> angles, lift, drag, moment;
  for (const AirfoilRow& row : rows) {
    angles.push_back(row.angle);
    lift.push_back(row.lift);
    drag.push_back(row.drag);
    moment.push_back(row.moment);
  }
  deck.open(name, "Polar");
  deck.set_degrees("Angles", angles);
  deck.set("Lift", lift);
  deck.set("Drag", drag);
  if (has_moments) deck.set("Moment", moment);
  deck.close();
}

void write_airfoils(const AeroDyn& loads, DeckWriter& deck) {
  deck.open("Airfoils");
  for (const AirfoilFile& airfoil : loads.airfoils) {
    write_polar(airfoil.name, airfoil.rows, loads.has_moments, deck);
  }
  deck.close();
}

// The fraction of the length at which the axis of a blade is at a height over its root.
double fraction_at(const Spline& curve, double height) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (curve.position(middle * curve.length()).z() < height ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The columns of a Strip.
struct Strips {
  std::vector<double> positions, chords, twists, axes;
  std::vector<std::string> airfoils;
};

// Stations of the air on the axis of the structure. Its sections are turned by an angle of their
// own, and the quarter chord has its offset from their axis.
Strips strips_of(const AeroBlade& blade, const AeroDyn& loads, const BeamDyn& beam,
                 Report& report) {
  const BladeAxis axis(beam.key_points);
  const double top = beam.key_points.back().position.z();
  const double whole = blade.stations.back().span;
  if (std::abs(whole - top) > 1e-3 * top) {
    report.add(unknown,
               fmt::format("{}: BlSpn ends at {:.6g} m, the blade at {:.6g} m: stations are "
                           "stretched to its length",
                           blade.path.string(), whole, top));
  }
  Strips strips;
  double farthest = 0.0, most_turned = 0.0;
  for (const AeroStation& station : blade.stations) {
    const bool is_last = &station == &blade.stations.back();
    const double s = station.span == 0.0 ? 0.0
                     : is_last           ? 1.0
                                         : fraction_at(axis.curve, station.span / whole * top);
    const Vec3 centre = axis.curve.position(s * axis.curve.length());
    const Vec<2> offset(station.curve - centre.x(), station.sweep - centre.y());
    const Vec<2> tail(std::sin(station.twist), std::cos(station.twist));
    const double turn = -station.twist - linear(axis.spans, axis.angles, s);
    strips.positions.push_back(s);
    strips.chords.push_back(station.chord);
    strips.twists.push_back(turn);
    strips.axes.push_back(0.25 - offset.dot(tail) / station.chord);
    strips.airfoils.push_back(loads.airfoils[station.airfoil].name);
    const Vec<2> rest = offset - offset.dot(tail) * tail;
    farthest = std::max(farthest, rest.norm() / station.chord);
    most_turned = std::max(most_turned, std::abs(turn));
  }
  report.add(checked,
             fmt::format("air: twists of {} and of the structure differ by {:.3g} degrees at "
                         "most, axes lie from {:.3g} to {:.3g} chords behind the nose",
                         blade.path.filename().string(), most_turned * 180.0 / std::numbers::pi,
                         *std::min_element(strips.axes.begin(), strips.axes.end()),
                         *std::max_element(strips.axes.begin(), strips.axes.end())));
  if (farthest > beside) {
    report.add(missing,
               fmt::format("{}: the quarter chord lies up to {:.3g} chords beside the chord "
                           "line through the axis of the structure: here it lies on it",
                           blade.path.string(), farthest));
  }
  return strips;
}

void write_blade_load(std::size_t i, const ElastoDyn& turbine, Report& report, DeckWriter& deck) {
  const AeroDyn& loads = turbine.air->loads;
  Report silent;  // blades of one file are told once
  const bool is_new = i == 0 || loads.blades[i].path != loads.blades[0].path;
  const Strips strips =
      strips_of(loads.blades[i], loads, turbine.blades[i].beam, is_new ? report : silent);
  deck.open(load_name(i), "Strip");
  deck.set("Structure", blade_name(i));
  deck.set("Flow", "wind");
  deck.set("Positions", strips.positions);
  deck.set("Chords", strips.chords);
  deck.set("Airfoils", strips.airfoils);
  deck.set_degrees("Twists", strips.twists);
  deck.set("Axes At", strips.axes);
  deck.set("Nose", std::vector<double>{0.0, -1.0});
  deck.set("Suction", std::vector<double>{1.0, 0.0});
  deck.set("Lag", loads.lag);
  deck.set("Apparent Mass", "false");
  deck.set("Stations", "stations");
  deck.close();
}

// The values of the file within the tower, held above and below.
void write_tower_load(const ElastoDyn& turbine, DeckWriter& deck) {
  const double base = turbine.tower_base, top = turbine.tower_top;
  std::vector<double> heights, diameters, drags, places{base};
  for (const AeroTowerStation& station : turbine.air->loads.tower) {
    heights.push_back(station.height);
    diameters.push_back(station.diameter);
    drags.push_back(station.drag);
    if (station.height > base && station.height < top) places.push_back(station.height);
  }
  places.push_back(top);
  std::vector<double> positions, diameters_there, drags_there;
  for (const double place : places) {
    positions.push_back((place - base) / (top - base));
    diameters_there.push_back(linear(heights, diameters, place));
    drags_there.push_back(linear(heights, drags, place));
  }
  deck.open(tower_load, "Strip Drag");
  deck.set("Structure", "tower");
  deck.set("Flow", "wind");
  deck.set("Positions", positions);
  deck.set("Diameters", diameters_there);
  deck.set("Drags", drags_there);
  deck.set("Stations", tower_stations);
  deck.close();
}

void write_rotor(const ElastoDyn& turbine, const TurbineLayout& layout, DeckWriter& deck) {
  const AeroDyn& loads = turbine.air->loads;
  std::vector<std::string> blades, losses;
  for (std::size_t i = 0; i < loads.blades.size(); ++i) blades.push_back(load_name(i));
  if (loads.tip_loss) losses.emplace_back("Tip");
  if (loads.hub_loss) losses.emplace_back("Hub");
  deck.open("induction", "Rotor");
  deck.set("Hub", "hub");
  deck.set("Axis", layout.shaft);
  deck.set("Blades", blades);
  deck.set("Induction", loads.induction);
  deck.set("Losses", losses);
  deck.set("Drag Induces", loads.drag_induces ? "true" : "false");
  deck.set("Yaw", loads.yaw);
  deck.close();
}

}  // namespace

void write_air_variables(const ElastoDyn& turbine, DeckWriter& deck) {
  constexpr double rpm = std::numbers::pi / 30.0;
  const Air& air = *turbine.air;
  if (has_mean(air.wind)) {
    deck.variable("V", air.wind.speed, fmt::format("wind at {:g} m [m/s]", air.wind.height));
  }
  deck.variable("W", turbine.rotor_speed / rpm, "speed of the rotor in operation", "rpm");
  deck.variable("stations", blade_stations, "of the air, per blade");
  deck.variable("step", time_step, "of the motion [s]");
  deck.variable("end", air.end, "of the motion [s]");
}

void write_air(const ElastoDyn& turbine, const std::filesystem::path& folder, Report& report,
               DeckWriter& deck) {
  const Air& air = *turbine.air;
  deck.open("Flows");
  write_flow(turbine, folder, report, deck);
  if (const SeaState* sea = turbine.sea()) write_sea(*sea, deck);
  deck.close();
  if (is_box(air.wind)) {
    report.add(assumed, is_endless(air.wind)
                            ? "wind: the box repeats itself, and is held beside, above and below it"
                            : "wind: the middle of the box passes the hub; it is known half its "
                              "width upwind from the start, and held outside of it");
  }
  write_airfoils(air.loads, deck);
  deck.open("Functions");
  deck.open("rotation", "Expression");
  deck.set("Expression", "W*t");
  deck.close();
  deck.close();
}

void write_air_loads(const ElastoDyn& turbine, const TurbineLayout& layout, Report& report,
                     DeckWriter& deck) {
  for (std::size_t i = 0; i < turbine.air->loads.blades.size(); ++i) {
    write_blade_load(i, turbine, report, deck);
  }
  if (!turbine.air->loads.tower.empty()) write_tower_load(turbine, deck);
  write_rotor(turbine, layout, deck);
  report.add(
      assumed,
      fmt::format("air: {} stations per blade; the angle of attack is that of the three-quarter "
                  "chord; coefficients are linear between the stations of the file",
                  blade_stations));
  report.add(assumed,
             fmt::format("operation: the generator turns at RotSpeed, {:.5g} rad/s, at constant "
                         "speed; the rotor begins to turn undeformed, so give it some seconds. "
                         "Without the wind: the analyses 'weight' and 'modes'",
                         turbine.rotor_speed));
}

void write_rotation(const TurbineLayout& layout, DeckWriter& deck) {
  deck.open("rotation", "Joint Angle");
  deck.set("First", "nacelle");
  deck.set("Second", "generator");
  deck.set("Axis", layout.shaft);
  deck.set("Angle", 1.0);
  deck.set("Function", "rotation");
  deck.close();
}

void write_initial_velocities(const ElastoDyn& turbine, const TurbineLayout& layout,
                              DeckWriter& deck) {
  std::vector<std::string> turning{"generator", "hub"};
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) turning.push_back(blade_name(i));
  deck.open("Initial Conditions");
  for (const std::string& name : turning) {
    deck.open(name, "Velocity");
    deck.set("Node", name);
    deck.set("Angular Velocity", times_speed(layout.shaft));
    deck.set("About", layout.apex);
    deck.close();
  }
  deck.close();
}

std::vector<std::string> names_of_air(const ElastoDyn& turbine) {
  std::vector<std::string> names{"rotation", "induction"};
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) names.push_back(load_name(i));
  if (!turbine.air->loads.tower.empty()) names.emplace_back(tower_load);
  return names;
}

void write_operation(DeckWriter& deck) {
  deck.open("operation", "Dynamic");
  deck.set("Start From", "Reference");
  deck.set("Start Time", 0.0);
  deck.set("End Time", "end");
  deck.set("Step", "step");
  deck.set("Inactive", std::vector<std::string>{"generator"});
  deck.comment({"What 1e-10 leaves at the far ends of the blades adds up in turbulence."});
  deck.open("Newton");
  deck.set("Force Tolerance", 1e-12);
  deck.close();
  deck.close();
}

void write_air_history(const ElastoDyn& turbine, DeckWriter& deck) {
  deck.open("aerodynamics", "Rotor");
  deck.set("Load", "induction");
  deck.close();
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    deck.open(blade_name(i) + " deflection", "Displacement");
    deck.set("Node", blade_name(i) + "/last");
    deck.set("Frame", "hub");
    deck.close();
    deck.open(blade_name(i) + " root", "Section Loads");
    deck.set("Structure", blade_name(i));
    deck.set("Station", 0);
    deck.close();
  }
}

}  // namespace culm::openfast
