#include "fluid_quantities.hpp"

#include <culm/base/absent.hpp>
#include <culm/base/nearest.hpp>
#include <culm/flow/fluid_force.hpp>
#include <culm/rotor/rotor_load.hpp>
#include <culm/strip/strip_load.hpp>
#include <culm/water/morison_load.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

namespace culm::simulation {
namespace {

using output::HistoryColumn;

// What coefficients are related to.
struct Reference {
  double pressure_area = 0.0;  // dynamic pressure times area [N]
  Vec3 lift, drag;             // unit vectors
};

class FluidForceQuantity final : public Quantity {
 public:
  FluidForceQuantity(const flow::FluidForce& load, Vec3 point, std::optional<Reference> reference)
      : load_(load), point_(std::move(point)), reference_(std::move(reference)) {}

  std::vector<HistoryColumn> columns() const override {
    std::vector<HistoryColumn> columns{{"Fx", "N"},   {"Fy", "N"},   {"Fz", "N"},
                                       {"Mx", "N m"}, {"My", "N m"}, {"Mz", "N m"}};
    if (reference_) columns.insert(columns.end(), {{"CL", "1"}, {"CD", "1"}});
    return columns;
  }
  void evaluate(const assembly::System& system, const model::State&,
                std::vector<double>& numbers) const override {
    const auto own = load_.resultant();
    if (!own) {  // before the first step there is none
      numbers.insert(numbers.end(), columns().size(), absent);
      return;
    }
    Vec6 sum;
    sum << own->force, own->moment - point_.cross(own->force);
    system.comm().sum({sum.data(), 6});
    numbers.insert(numbers.end(), sum.begin(), sum.end());
    if (!reference_) return;
    const Vec3 force = sum.head<3>();
    numbers.push_back(force.dot(reference_->lift) / reference_->pressure_area);
    numbers.push_back(force.dot(reference_->drag) / reference_->pressure_area);
  }

 private:
  const flow::FluidForce& load_;
  Vec3 point_;
  std::optional<Reference> reference_;
};

// Coefficients want all three of their parameters.
std::optional<Reference> read_reference(const Options& options, InputIssues& issues) {
  const bool wanted = options.has("Area") || options.has("Dynamic Pressure");
  if (!wanted) return {};
  if (!options.has("Area") || !options.has("Dynamic Pressure")) {
    issues.add(options.where(), "coefficients need both 'Area' and 'Dynamic Pressure'");
    return {};
  }
  const Vec3 drag = model::vector(options, "Drag Direction");
  const Vec3 up = model::vector(options, "Lift Direction");
  if (drag.cross(up).norm() <= 1e-9 * drag.norm() * up.norm()) {
    issues.add(options.where("Drag Direction"),
               "must not be zero, nor parallel to 'Lift Direction'");
    return {};
  }
  const Vec3 along = drag.normalized();
  return Reference{options.number("Area") * options.number("Dynamic Pressure"),
                   (up - up.dot(along) * along).normalized(), along};
}

std::unique_ptr<Quantity> make_force(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Load");
  auto reference = read_reference(options, context.issues);
  std::vector<std::string> names;
  for (const auto& batch : context.model.loads()) {
    const auto* load = dynamic_cast<const flow::FluidForce*>(batch.get());
    if (load == nullptr) continue;
    names.push_back(batch->effect().name);
    if (names.back() != name) continue;
    return std::make_unique<FluidForceQuantity>(*load, model::vector(options, "Point"),
                                                std::move(reference));
  }
  context.issues.add(options.where("Load"),
                     "no load of a flow '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

// What a station of a strip load saw and felt in the step.
class StripQuantity final : public Quantity {
 public:
  StripQuantity(const strip::StripLoad& load, int station) : load_(load), station_(station) {}

  // What others induce, and how much of the flow is attached, where there is such a thing.
  std::vector<HistoryColumn> columns() const override {
    std::vector<HistoryColumn> columns{{"alpha", "rad"}, {"alpha E", "rad"}, {"V", "m/s"},
                                       {"Cl", "1"},      {"Cd", "1"},        {"Cm", "1"},
                                       {"Fn", "N/m"},    {"Ft", "N/m"}};
    if (load_.inducer() != nullptr) {
      columns.insert(columns.end(), {{"phi", "rad"}, {"a", "1"}, {"a'", "1"}});
    }
    if (load_.kind().stall != strip::Stall::none) columns.push_back({"f", "1"});
    return columns;
  }
  void evaluate(const assembly::System& system, const model::State&,
                std::vector<double>& numbers) const override {
    const std::optional<strip::StationState> s = load_.state(station_);
    if (!s) {
      numbers.insert(numbers.end(), columns().size(), absent);
      return;
    }
    std::vector<double> values{s->angle,           s->effective_angle, s->speed,
                               s->coefficients[0], s->coefficients[1], s->coefficients[2],
                               s->normal,          s->tangential};
    if (load_.inducer() != nullptr) {
      values.insert(values.end(), {s->inflow_angle, s->axial, s->tangential_induction});
    }
    if (load_.kind().stall != strip::Stall::none) values.push_back(s->attached);
    // one rank has it, so the sum is exact
    if (!load_.owns(station_)) std::ranges::fill(values, 0.0);
    system.comm().sum({values.data(), values.size()});
    numbers.insert(numbers.end(), values.begin(), values.end());
  }

 private:
  const strip::StripLoad& load_;
  int station_;
};

std::unique_ptr<Quantity> make_strip(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Load");
  const int station = options.integer("Station");
  std::vector<std::string> names;
  for (const auto& batch : context.model.loads()) {
    const auto* load = dynamic_cast<const strip::StripLoad*>(batch.get());
    if (load == nullptr) continue;
    names.push_back(batch->effect().name);
    if (names.back() != name) continue;
    if (station < load->size()) return std::make_unique<StripQuantity>(*load, station);
    context.issues.add(options.where("Station"),
                       "'" + name + "' has stations 0 to " + std::to_string(load->size() - 1));
    return nullptr;
  }
  context.issues.add(options.where("Load"), "no strips '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

// What the air of its blades does to a rotor in the step.
class RotorQuantity final : public Quantity {
 public:
  explicit RotorQuantity(const rotor::RotorLoad& rotor) : rotor_(rotor) {}

  std::vector<HistoryColumn> columns() const override {
    return {{"thrust", "N"}, {"torque", "N m"}, {"power", "W"}, {"speed", "rad/s"},
            {"CT", "1"},     {"CP", "1"},       {"TSR", "1"},   {"wind", "m/s"},
            {"yaw", "rad"},  {"a", "1"},        {"CQ", "1"},    {"azimuth", "rad"}};
  }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const std::optional<rotor::RotorState> rotor = rotor_.state();
    if (!rotor) {
      numbers.insert(numbers.end(), columns().size(), absent);
      return;
    }
    Vec6 sum = Vec6::Zero();
    for (const strip::StripLoad* blade : rotor_.blades()) {
      const auto part = blade->resultant();
      if (part) sum += (Vec6() << part->force, part->moment).finished();
    }
    system.comm().sum({sum.data(), 6});
    const Vec3 force = sum.head<3>();
    const Vec3 moment = sum.tail<3>() - rotor->centre.cross(force);
    const double thrust = force.dot(rotor->axis);
    const double torque = moment.dot(rotor->axis);
    const double power = torque * rotor->speed;
    const double wind = rotor->wind.norm();
    const double radius = rotor_.tip_radius();
    const double push = 0.5 * rotor_.density() * wind * wind * std::numbers::pi * radius * radius;
    // without wind there is nothing to refer to
    const auto over = [](double a, double b) { return b == 0.0 ? absent : a / b; };
    const double yaw =
        std::atan2(rotor->axis.cross(rotor->wind).norm(), rotor->axis.dot(rotor->wind));
    const double values[] = {thrust,
                             torque,
                             power,
                             rotor->speed,
                             over(thrust, push),
                             over(power, push * wind),
                             over(std::abs(rotor->speed) * radius, wind),
                             wind,
                             yaw,
                             rotor->induction,
                             over(torque, push * radius),
                             rotor_.azimuth(state.next)};
    numbers.insert(numbers.end(), std::begin(values), std::end(values));
  }

 private:
  const rotor::RotorLoad& rotor_;
};

std::unique_ptr<Quantity> make_rotor(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Load");
  std::vector<std::string> names;
  for (const auto& batch : context.model.loads()) {
    const auto* load = dynamic_cast<const rotor::RotorLoad*>(batch.get());
    if (load == nullptr) continue;
    names.push_back(batch->effect().name);
    if (names.back() == name) return std::make_unique<RotorQuantity>(*load);
  }
  context.issues.add(options.where("Load"), "no rotor '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

// The sea of a load, which no structure disturbs, at a place.
class WavesQuantity final : public Quantity {
 public:
  WavesQuantity(const water::Sea& sea, Vec3 place) : sea_(sea), place_(std::move(place)) {}

  std::vector<HistoryColumn> columns() const override {
    return {{"elevation", "m"}, {"vx", "m/s"},   {"vy", "m/s"},   {"vz", "m/s"},
            {"ax", "m/s^2"},    {"ay", "m/s^2"}, {"az", "m/s^2"}, {"p", "Pa"}};
  }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    // in statics time is the load level, and the sea is that at time 0
    const double time = state.in_motion ? state.time : 0.0;
    const water::WaterMotion water = sea_.motion(place_, time);
    numbers.push_back(sea_.elevation(place_, time));
    numbers.insert(numbers.end(), water.velocity.begin(), water.velocity.end());
    numbers.insert(numbers.end(), water.acceleration.begin(), water.acceleration.end());
    numbers.push_back(water.pressure);
  }

 private:
  const water::Sea& sea_;
  Vec3 place_;
};

std::unique_ptr<Quantity> make_waves(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Load");
  std::vector<std::string> names;
  for (const auto& batch : context.model.loads()) {
    const auto* load = dynamic_cast<const water::MorisonLoad*>(batch.get());
    if (load == nullptr) continue;
    names.push_back(batch->effect().name);
    if (names.back() != name) continue;
    return std::make_unique<WavesQuantity>(load->sea(), model::vector(options, "Point"));
  }
  context.issues.add(options.where("Load"),
                     "no load of a sea '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

}  // namespace

void register_fluid_quantities(QuantityRegistry& registry) {
  registry.add(
      "Fluid Force",
      Schema("Fluid Force",
             "Resultant of a load of a flow on the structures, in the step, and its moment about a "
             "point; with a reference, coefficients of lift and drag.")
          .add(text("Load", "Its name in the list Loads."))
          .add(model::vector_field("Point", "m", "Point of the moment.").optional({0.0, 0.0, 0.0}))
          .add(number("Area", "m^2", "Reference of the coefficients; none without it.")
                   .positive()
                   .optional())
          .add(number("Dynamic Pressure", "Pa", "Reference of the coefficients.")
                   .positive()
                   .optional())
          .add(model::vector_field("Drag Direction", "1", "Of the wind.").optional({1.0, 0.0, 0.0}))
          .add(model::vector_field("Lift Direction", "1",
                                   "Upwards; its part across the wind is taken.")
                   .optional({0.0, 0.0, 1.0})),
      make_force);
  registry.add(
      "Strip",
      Schema("Strip",
             "Angle of attack, the angle behind the lag, wind across the span, coefficients, "
             "and forces per length towards the suction side and towards the tail, of a "
             "station in the step; on the blade of a rotor the angle of the inflow to the plane of "
             "rotation and the induction through it and in it, with stall the attached share.")
          .add(text("Load", "Name of the strips, or of the strip drag, in the list Loads."))
          .add(integer("Station", "Number of the station, from 0.").at_least(0).optional(0)),
      make_strip);
  registry.add(
      "Rotor",
      Schema(
          "Rotor",
          "Thrust, torque about the axis downwind, power and speed of a rotor in the step; its "
          "coefficients of thrust, power and torque and its tip speed ratio, by the mean wind "
          "over its disc, as the moving hub feels it, and the radius of its tips in the reference; "
          "this wind, its angle to the axis, and the mean axial induction that the balance of "
          "momentum asks for; last how "
          "far the hub has turned about the axis at the end of the step, from 0 to 2 pi.")
          .add(text("Load", "Name of the rotor in the list Loads.")),
      make_rotor);
  registry.add(
      "Waves",
      Schema("Waves",
             "The sea that a load stands in, at a point, as if no structure were there: height of "
             "the surface over still water, velocity with the current, acceleration, and the "
             "pressure of the waves.")
          .add(text("Load", "Name of the load of type Morison in the list Loads."))
          .add(model::vector_field("Point", "m", "Where.").optional({0.0, 0.0, 0.0})),
      make_waves);
}

}  // namespace culm::simulation
