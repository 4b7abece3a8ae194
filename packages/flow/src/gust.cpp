// Gusts of IEC 61400-1, section 6.3.3 (edition 4; edition 3 has the same formulas).
#include "reference_wind.hpp"
#include "tower_influence.hpp"

#include <algorithm>
#include <numbers>

namespace culm::flow {
namespace {

using std::numbers::pi;

// The wind at hub height, and the class of the turbine.
struct Site {
  double speed, height, diameter;
  double reference_speed;  // V_ref
  double intensity;        // I_ref

  double deviation() const { return intensity * (0.75 * speed + 5.6); }  // sigma_1
  double length() const { return 0.7 * std::min(height, 60.0); }         // Lambda_1
};

// A change of the wind: speed added everywhere, per length upwards and across, and a turn.
struct Change {
  double speed = 0.0, upwards = 0.0, across = 0.0, turn = 0.0;
};

// From 0 to 1 over the duration, and kept.
double rise(double time, double duration) {
  return 0.5 * (1.0 - std::cos(pi * std::min(time, duration) / duration));
}

Change operating_gust(const Site& site, double time) {
  constexpr double duration = 10.5;
  if (time >= duration) return {};
  // the extreme wind of one year at hub height is 0.8 times that of fifty
  const double yearly = 0.8 * 1.4 * site.reference_speed;
  const double gust =
      std::min(1.35 * (yearly - site.speed),
               3.3 * site.deviation() / (1.0 + 0.1 * site.diameter / site.length()));
  const double phase = pi * time / duration;
  return {.speed = -0.37 * gust * std::sin(3.0 * phase) * (1.0 - std::cos(2.0 * phase))};
}

Change direction_change(const Site& site, double time, double sign) {
  const double full = 4.0 * std::atan(site.deviation() /
                                      (site.speed * (1.0 + 0.1 * site.diameter / site.length())));
  return {.turn = sign * full * rise(time, 6.0)};
}

Change coherent_gust(const Site& site, double time, double sign) {
  const double full = site.speed < 4.0 ? pi : 4.0 * pi / site.speed;
  const double part = rise(time, 10.0);
  return {.speed = 15.0 * part, .turn = sign * full * part};
}

double shear_gust(const Site& site, double time) {
  constexpr double duration = 12.0;
  if (time >= duration) return 0.0;
  const double amplitude =
      2.5 + 0.2 * 6.4 * site.deviation() * std::pow(site.diameter / site.length(), 0.25);
  return amplitude / site.diameter * (1.0 - std::cos(2.0 * pi * time / duration));
}

class Gust final : public Flow {
 public:
  Gust(const Options& options, const Site& site)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        site_(site),
        exponent_(options.number("Exponent")),
        start_(options.number("Start")),
        sign_(options.flag("Reversed") ? -1.0 : 1.0),
        shape_(options.text("Shape")),
        horizontal_(options.text("Shear") == "Horizontal") {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    const Change change = change_at(time - start_);
    const Vec3 along = axes_.turned(change.turn);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double height = axes_.height(places[i]);
      const double speed = site_.speed * power_law(height, site_.height, exponent_) + change.speed +
                           change.upwards * (height - site_.height) +
                           change.across * axes_.across.dot(places[i]);
      velocities[i] = speed * along;
    }
  }
  Mat3 gradient(const Vec3& place, double time) const override {
    const Change change = change_at(time - start_);
    const double slope =
        site_.speed * power_law_slope(axes_.height(place), site_.height, exponent_);
    const Vec3 shear = (slope + change.upwards) * axes_.up + change.across * axes_.across;
    return axes_.turned(change.turn) * shear.transpose();
  }

  bool is_above_ground(const Vec3& place) const override { return axes_.height(place) > 0.0; }

 private:
  Change change_at(double time) const {
    if (time <= 0.0) return {};
    if (shape_ == "EOG") return operating_gust(site_, time);
    if (shape_ == "EDC") return direction_change(site_, time, sign_);
    if (shape_ == "ECD") return coherent_gust(site_, time, sign_);
    const double shear = sign_ * shear_gust(site_, time);
    return horizontal_ ? Change{.across = shear} : Change{.upwards = shear};
  }

  WindAxes axes_;
  Site site_;
  double exponent_, start_, sign_;
  std::string shape_;
  bool horizontal_;
};

// Class such as "1A" or "2A+": reference speed by the number, intensity by the letter.
Site read_site(const Options& options) {
  const std::string& name = options.text("Class");
  const double speeds[] = {50.0, 42.5, 37.5};
  const std::string category = name.substr(1);
  const double intensity = category == "A+"  ? 0.18
                           : category == "A" ? 0.16
                           : category == "B" ? 0.14
                                             : 0.12;
  return {options.number("Speed"), options.number("Height"), options.number("Diameter"),
          speeds[name[0] - '1'], intensity};
}

}  // namespace

void register_gust(FlowRegistry& registry) {
  add_wind(
      registry, "Gust",
      reference_wind_schema("Gust", "A gust of IEC 61400-1 in a wind with power law.")
          .add(number("Exponent", "1", "Exponent of the height.").non_negative().optional(0.2))
          .add(choice("Shape", {"EOG", "EDC", "ECD", "EWS"},
                      "Extreme operating gust, extreme direction change, extreme coherent gust "
                      "with direction change, extreme wind shear."))
          .add(choice("Class",
                      {"1A+", "1A", "1B", "1C", "2A+", "2A", "2B", "2C", "3A+", "3A", "3B", "3C"},
                      "Class of the turbine: extreme wind and turbulence."))
          .add(number("Diameter", "m", "Diameter of the rotor.").positive())
          .add(number("Start", "s", "When the gust begins.").optional(0.0))
          .add(choice("Shear", {"Vertical", "Horizontal"}, "Where the wind of EWS grows to.")
                   .optional("Vertical"))
          .add(flag("Reversed",
                    "The other sign of direction change or shear: counter-clockwise from above, "
                    "less wind above or to the left.")
                   .optional(false))
          .check([](const Options& options, InputIssues& issues) {
            if (options.number("Speed") > 0.0) return;
            issues.add(options.where("Speed"), "a gust needs a wind, got 0 m/s");
          }),
      [](const Options& options, model::BuildContext&) -> SharedFlow {
        return std::make_shared<Gust>(options, read_site(options));
      });
}

}  // namespace culm::flow
