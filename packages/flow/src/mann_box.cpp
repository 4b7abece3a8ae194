#include "box.hpp"
#include "mann_files.hpp"
#include "reference_wind.hpp"
#include "tower_influence.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace culm::flow {
namespace {

// A wind with power law, and what a box adds to it.
class TurbulentWind final : public Flow {
 public:
  TurbulentWind(const Options& options, SharedFlow fluctuations)
      : Flow(options.number("Density")),
        axes_(read_wind_axes(options)),
        speed_(options.number("Speed")),
        height_(options.number("Height")),
        exponent_(options.number("Exponent")),
        fluctuations_(std::move(fluctuations)) {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    fluctuations_->velocities(places, time, velocities);
    for (std::size_t i = 0; i < places.size(); ++i) {
      velocities[i] +=
          speed_ * power_law(axes_.height(places[i]), height_, exponent_) * axes_.along;
    }
  }

 private:
  WindAxes axes_;
  double speed_, height_, exponent_;
  SharedFlow fluctuations_;
};

// Of one component over the whole box.
double deviation(const TurbulenceGrid& grid, std::size_t component) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = component; i < grid.values.size(); i += 3) {
    sum += grid.values[i];
    squares += static_cast<double>(grid.values[i]) * grid.values[i];
  }
  const double count = static_cast<double>(grid.values.size()) / 3.0;
  const double mean = sum / count;
  return std::sqrt(std::max(squares / count - mean * mean, 0.0));
}

void scale(const Options& options, TurbulenceGrid& grid) {
  const std::vector<double>& wanted = options.numbers("Deviations");
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    const double found = deviation(grid, c);
    if (found == 0.0 && wanted[c] > 0.0) {
      throw InputError(
          options.where("Deviations"),
          fmt::format("component {} of the box does not vary, so it cannot be scaled", c + 1));
    }
    const double factor = found > 0.0 ? wanted[c] / found : 0.0;
    for (std::size_t i = c; i < grid.values.size(); i += 3) {
      grid.values[i] = static_cast<float>(factor * grid.values[i]);
      if (!std::isfinite(grid.values[i])) {
        throw InputError(options.where("Deviations"),
                         fmt::format("component {} of the box, which varies by {:g} m/s, cannot be "
                                     "scaled to {:g} m/s",
                                     c + 1, found, wanted[c]));
      }
    }
  }
}

SharedFlow make_mann_box(const Options& options, model::BuildContext&) {
  const std::vector<int>& n = options.integers("Points");
  const std::vector<double>& d = options.numbers("Spacing");
  TurbulenceGrid grid = read_mann(options.texts("File Names"), options.where("File Names"),
                                  {n[0], n[1], n[2]}, {d[0], d[1], d[2]}, options.number("Speed"));
  if (options.has("Deviations")) scale(options, grid);
  return std::make_shared<TurbulentWind>(options, make_box(options, std::move(grid)));
}

}  // namespace

void register_mann_box(FlowRegistry& registry) {
  add_wind(
      registry, "Mann Box",
      box_schema("Mann Box",
                 "Turbulence of three files as HAWC2 and Mann's generator write them, added to a "
                 "wind with power law. The box repeats itself along the wind.")
          .add(number("Speed", "m/s", "Mean speed at 'Height', with which the box moves.")
                   .positive())
          .add(number("Height", "m", "Height above the origin, along 'Up', at which 'Speed' holds.")
                   .positive())
          .add(number("Exponent", "1", "Exponent of the height.").non_negative().optional(0.2))
          .add(texts("File Names",
                     "Binary files of the components along the wind, across it and upwards, "
                     "relative to the deck.")
                   .size(3))
          .add(integers("Points", "Points of the box along the wind, across it and upwards.")
                   .size(3)
                   .at_least(2))
          .add(numbers("Spacing", "m", "Distances between them.").size(3).positive())
          .add(numbers("Deviations", "m/s",
                       "Standard deviations of the components over the box, to which they are "
                       "scaled; as the files have them if absent.")
                   .size(3)
                   .non_negative()
                   .optional()),
      make_mann_box);
}

}  // namespace culm::flow
