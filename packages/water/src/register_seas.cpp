#include <culm/model/build_context.hpp>
#include <culm/water/dispersion.hpp>
#include <culm/water/register_water.hpp>
#include <culm/water/sea.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace culm::water {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

Schema still_schema(const std::string& name, const std::string& doc) {
  return Schema(name, doc)
      .add(number("Density", "kg/m^3", "Mass of the water per volume.").positive().optional(1025.0))
      .add(number("Depth", "m", "From still water to the bed.").positive())
      .add(number("Gravity", "m/s^2", "Acceleration of free fall.").positive().optional(9.81))
      .add(number("Level", "m", "Height of still water above the origin.").optional(0.0))
      .add(model::vector_field("Up", "1", "Away from the bed, of any length.")
               .optional({0.0, 0.0, 1.0}))
      .add(model::vector_field("Direction", "1",
                               "Where waves and current go to, of any length, without its vertical "
                               "part.")
               .optional({1.0, 0.0, 0.0}))
      .add(number("Shown", "m",
                  "Side of the square of the surface around the origin that pictures show, in "
                  "run_fluid.pvd; none if absent.")
               .positive()
               .optional())
      .list_by_type("Current", current_types(), Presence::optional)
      .check([](const Options& options, InputIssues& issues) {
        const Vec3 up = model::vector(options, "Up");
        const auto check_direction = [&](const Options& entry) {
          const Vec3 direction = model::vector(entry, "Direction");
          if (direction.cross(up).norm() > 1e-6 * direction.norm() * up.norm()) return;
          issues.add(entry.where("Direction"), "'Direction' and 'Up' must not be parallel or zero");
        };
        check_direction(options);
        if (!options.has_list("Current")) return;
        const Options& current = options.list("Current");
        if (current.has("Direction")) check_direction(current);
      });
}

Schema wave_schema(const std::string& name, const std::string& doc) {
  return still_schema(name, doc)
      .add(
          choice("Stretching", {"None", "Vertical", "Wheeler"},
                 "What the water does between still water and the crests: nothing, and nothing is "
                 "wet there; as at still water; or profiles stretched from the bed to the surface.")
              .optional("Wheeler"))
      .add(number("Rise", "s", "Time in which the waves grow from nothing, by half a cosine.")
               .non_negative()
               .optional(0.0));
}

Site read_site(const Options& options) {
  return {options.number("Density"), options.number("Depth"), options.number("Gravity"),
          options.number("Level"), model::vector(options, "Up").normalized()};
}

Vec3 read_direction(const Options& options, const Vec3& up) {
  const Vec3 direction = model::vector(options, "Direction");
  return (direction - direction.dot(up) * up).normalized();
}

// Counter-clockwise seen from above.
Vec3 turned(const Vec3& direction, double angle, const Vec3& up) {
  return std::cos(angle) * direction + std::sin(angle) * up.cross(direction);
}

Stretching read_stretching(const Options& options) {
  const std::string& name = options.text("Stretching");
  if (name == "None") return Stretching::none;
  return name == "Vertical" ? Stretching::vertical : Stretching::wheeler;
}

// @param waves  without numbers, and without directions where they go with the sea
flow::SharedFlow make_sea(const Options& options, std::vector<Wave> waves, Stretching stretching,
                          double rise) {
  const Site site = read_site(options);
  const Vec3 direction = read_direction(options, site.up);
  for (Wave& wave : waves) {
    wave.number = wave_number(wave.frequency, site.depth, site.gravity);
    if (wave.direction.isZero(0.0)) wave.direction = direction;
  }
  Current current;
  if (options.has_list("Current")) {
    current = read_current(options.list("Current"), direction, site.up, site.depth);
  }
  return std::make_shared<Sea>(site, std::move(waves), std::move(current), stretching, rise,
                               options.has("Shown") ? options.number("Shown") : 0.0);
}

flow::SharedFlow make_sea(const Options& options, std::vector<Wave> waves) {
  return make_sea(options, std::move(waves), read_stretching(options), options.number("Rise"));
}

Wave wave_of(double amplitude, double period, double phase) {
  return {amplitude, turn / period, 0.0, phase};
}

std::string breaking(double height, double period, const Options& options) {
  const double depth = options.number("Depth");
  const double limit =
      breaking_height(wave_number(turn / period, depth, options.number("Gravity")), depth);
  if (std::abs(height) <= limit) return {};
  return fmt::format("waves of this period break above {:.4g} m, got {:g} m", limit, height);
}

// Of a sea that waves of one height and period stand for.
void check_height(const Options& options, InputIssues& issues) {
  const std::string text = breaking(options.number("Height"), options.number("Period"), options);
  if (!text.empty()) issues.add(options.where("Height"), text);
}

void register_regular(flow::FlowRegistry& registry) {
  registry.add(
      "Regular Waves",
      wave_schema("Regular Waves", "Water with waves of one period, by Airy's theory.")
          .add(number("Height", "m", "From trough to crest.").non_negative())
          .add(number("Period", "s", "Period.").positive())
          .add(number("Phase", "rad",
                      "At 0 a crest is at the origin at the start; with more, it comes later.")
                   .optional(0.0))
          .check(check_height),
      [](const Options& options, model::BuildContext&) {
        return make_sea(options, {wave_of(0.5 * options.number("Height"), options.number("Period"),
                                          options.number("Phase"))});
      });
}

Band read_band(const Options& options) {
  const double peak = 1.0 / options.number("Period");
  return {options.has("Lowest") ? options.number("Lowest") : 0.5 * peak,
          options.has("Highest") ? options.number("Highest") : 4.0 * peak};
}

void check_irregular(const Options& options, InputIssues& issues) {
  const Band band = read_band(options);
  const double peak = 1.0 / options.number("Period");
  if (band.lowest >= peak || band.highest <= peak) {
    issues.add(options.where(band.lowest >= peak ? "Lowest" : "Highest"),
               fmt::format("waves from {:g} to {:g} Hz must have the peak, {:g} Hz, among them",
                           band.lowest, band.highest, peak));
  }
  // in parts as wide as the peak one wave may get all of its energy, or none does
  constexpr double widest = 0.25;
  const int count = options.integer("Waves");
  const double part = (band.highest - band.lowest) / count;
  if (part > widest * peak && band.highest > 4.0 * peak) {
    issues.add(options.where("Highest"),
               fmt::format("{} waves up to {:g} Hz are {:.3g} Hz apart, more than a quarter of the "
                           "frequency of the peak, {:g} Hz: a lower 'Highest' or more 'Waves'",
                           count, band.highest, part, peak));
  }
  if (options.text("Spectrum") == "Pierson Moskowitz" && options.has("Peak")) {
    issues.add(options.where("Peak"), "is 1 in a spectrum of Pierson and Moskowitz; leave it out");
  }
  if (options.has("Spreading Range") && !options.has("Spreading")) {
    issues.add(options.where("Spreading Range"), "needs 'Spreading'");
  }
  // the mean of the highest third of its waves
  check_height(options, issues);
}

std::vector<Wave> read_irregular(const Options& options) {
  SeaState sea{options.number("Height"), options.number("Period"), 1.0};
  if (options.text("Spectrum") == "JONSWAP") {
    sea.peak = options.has("Peak") ? options.number("Peak") : usual_peak(sea.height, sea.period);
  }
  const auto seed = static_cast<std::uint64_t>(options.integer("Seed"));
  std::vector<Wave> waves = random_waves(sea, read_band(options), options.integer("Waves"), seed);
  if (!options.has("Spreading")) return waves;
  const double range =
      options.has("Spreading Range") ? options.number("Spreading Range") : std::numbers::pi;
  const std::vector<double> angles =
      spread_angles({options.number("Spreading"), range}, options.integer("Waves"), seed);
  const Vec3 up = model::vector(options, "Up").normalized();
  for (std::size_t i = 0; i < waves.size(); ++i) {
    waves[i].direction = turned(read_direction(options, up), angles[i], up);
  }
  return waves;
}

void register_irregular(flow::FlowRegistry& registry) {
  registry.add(
      "Irregular Waves",
      wave_schema("Irregular Waves",
                  "Water with a sum of waves by a spectrum, in one direction or spread about it.")
          .add(choice("Spectrum", {"JONSWAP", "Pierson Moskowitz"},
                      "Of a sea that grows, or of a grown one.")
                   .optional("JONSWAP"))
          .add(number("Height", "m", "Significant height: four standard deviations of the surface.")
                   .positive())
          .add(number("Period", "s", "Period of the peak.").positive())
          .add(number("Peak", "1",
                      "The factor gamma of JONSWAP; if absent, by height and period as in IEC "
                      "61400-3.")
                   .between(1.0, 10.0)
                   .optional())
          .add(integer("Waves", "How many; their frequencies never repeat together.")
                   .between(1, 100000)
                   .optional(200))
          .add(integer("Seed", "Chooses frequencies and phases; the same on every machine.")
                   .at_least(0)
                   .optional(0))
          .add(number("Lowest", "Hz", "Lowest frequency; half that of the peak if absent.")
                   .positive()
                   .optional())
          .add(number("Highest", "Hz", "Highest frequency; four times that of the peak if absent.")
                   .positive()
                   .optional())
          .add(number("Spreading", "1",
                      "Exponent n of the density of directions, cos^n(pi angle / range); all "
                      "waves go in one direction if absent.")
                   .between(0.0, 1000.0)
                   .optional())
          .add(number("Spreading Range", "rad",
                      "Range of these angles, half of it on each side; pi if absent.")
                   .greater_than(0.0)
                   .at_most(turn)
                   .optional())
          .check(check_irregular),
      [](const Options& options, model::BuildContext&) {
        return make_sea(options, read_irregular(options));
      });
}

void check_components(const Options& options, InputIssues& issues) {
  const std::vector<double>& periods = options.numbers("Periods");
  const std::size_t count = periods.size();
  for (const char* name : {"Heights", "Phases", "Turns"}) {
    if (!options.has(name) || options.numbers(name).size() == count) continue;
    issues.add(options.where(name),
               fmt::format("must have one value for each of {} 'Periods', got {}", count,
                           options.numbers(name).size()));
  }
  const std::vector<double>& heights = options.numbers("Heights");
  if (heights.size() != count) return;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string text = breaking(heights[i], periods[i], options);
    if (!text.empty())
      issues.add(options.where("Heights"), fmt::format("item {}: {}", i + 1, text));
  }
}

std::vector<Wave> read_components(const Options& options) {
  const std::vector<double>& periods = options.numbers("Periods");
  const Vec3 up = model::vector(options, "Up").normalized();
  const Vec3 ahead = read_direction(options, up);
  std::vector<Wave> waves;
  for (std::size_t i = 0; i < periods.size(); ++i) {
    const double phase = options.has("Phases") ? options.numbers("Phases")[i] : 0.0;
    waves.push_back(wave_of(0.5 * options.numbers("Heights")[i], periods[i], phase));
    const double angle = options.has("Turns") ? options.numbers("Turns")[i] : 0.0;
    waves.back().direction = turned(ahead, angle, up);
  }
  return waves;
}

void register_components(flow::FlowRegistry& registry) {
  registry.add(
      "Wave Components",
      wave_schema("Wave Components", "Water with waves that are given one by one.")
          .add(numbers("Periods", "s", "Periods.").positive().min_size(1))
          .add(numbers("Heights", "m", "Heights from trough to crest.").min_size(1))
          .add(numbers("Phases", "rad", "As of 'Regular Waves'; 0 if absent.").optional())
          .add(numbers("Turns", "rad",
                       "Of their directions from 'Direction', counter-clockwise from above; 0 if "
                       "absent.")
                   .optional())
          .check(check_components),
      [](const Options& options, model::BuildContext&) {
        return make_sea(options, read_components(options));
      });
}

}  // namespace

void register_seas(flow::FlowRegistry& registry) {
  registry.add("Still Water", still_schema("Still Water", "Water without waves."),
               [](const Options& options, model::BuildContext&) {
                 return make_sea(options, {}, Stretching::none, 0.0);
               });
  register_regular(registry);
  register_irregular(registry);
  register_components(registry);
}

}  // namespace culm::water
