#include "box.hpp"

#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::flow {
namespace {

// by which a point may leave the grid, in spacings: rounding of coordinates
constexpr double rounding = 1e-9;

class Box final : public Flow {
 public:
  Box(const Options& options, TurbulenceGrid grid)
      : Flow(options.number("Density")),
        where_(options.where()),
        axes_(read_wind_axes(options)),
        centre_(model::vector(options, "Centre")),
        // by default all planes within half a width of the centre are known from the start
        delay_(options.has("Delay") ? options.number("Delay") : 0.5 * grid.width() / grid.speed),
        holds_(options.text("Outside") == "Hold"),
        grid_(std::move(grid)) {}

  void velocities(std::span<const Vec3> places, double time,
                  std::span<Vec3> velocities) const override {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vec3 inside = find_inside(places[i], time);
      velocities[i] = directions() * grid_.at(inside[0], inside[1], inside[2]);
    }
  }
  Mat3 gradient(const Vec3& place, double time) const override {
    const Vec3 wanted = coordinates(place, time), inside = find_inside(place, time);
    Mat3 by_place;
    by_place << axes_.across.transpose(), axes_.normal.transpose(),
        -axes_.along.transpose() / grid_.speed;
    for (int i = 0; i < 3; ++i) {
      if (wanted[i] != inside[i]) by_place.row(i).setZero();  // held
    }
    return directions() * grid_.slope_at(inside[0], inside[1], inside[2]) * by_place;
  }

 private:
  Mat3 directions() const {
    Mat3 result;
    result << axes_.along, axes_.across, axes_.normal;
    return result;
  }
  // Of a place in the grid: across, upwards [m] and in time [s].
  Vec3 coordinates(const Vec3& place, double time) const {
    const Vec3 from_centre = place - centre_;
    // what is at the place now was at the centre by the way over the speed earlier
    double moment = time + delay_ - axes_.along.dot(from_centre) / grid_.speed;
    if (grid_.periodic) moment -= std::floor(moment / grid_.duration()) * grid_.duration();
    return {axes_.across.dot(from_centre) + 0.5 * grid_.width(),
            axes_.normal.dot(from_centre) + 0.5 * grid_.height(), moment};
  }
  // The nearest ones that are known.
  Vec3 find_inside(const Vec3& place, double time) const {
    const Vec3 at = coordinates(place, time);
    return {within(at[0], grid_.width(), grid_.spacing[0], "across the wind", place, time),
            within(at[1], grid_.height(), grid_.spacing[1], "upwards", place, time),
            within(at[2], grid_.duration(), grid_.interval, "in time", place, time)};
  }

  double within(double value, double size, double spacing, const char* direction, const Vec3& place,
                double time) const {
    const double inside = std::clamp(value, 0.0, size);
    if (holds_ || std::abs(value - inside) <= rounding * spacing) return inside;
    throw InputError(
        where_,
        fmt::format("the place {{{:g}, {:g}, {:g}}} m at {:g} s is outside of the box {}: it would "
                    "be at {:g} of 0 to {:g} {}; take a larger box, or 'Outside' = 'Hold'",
                    place[0], place[1], place[2], time, direction, value, size,
                    std::string_view(direction) == "in time" ? "s" : "m"));
  }

  Where where_;
  WindAxes axes_;
  Vec3 centre_;
  double delay_;
  bool holds_;
  TurbulenceGrid grid_;
};

}  // namespace

Schema box_schema(const std::string& name, const std::string& doc) {
  return Schema(name, doc)
      .add(density_field())
      .add(model::vector_field("Centre", "m", "Place through which the middle of the box moves."))
      .add(number("Delay", "s",
                  "Time in the box at the centre at the start; if absent, half the width of the "
                  "box over the mean speed, so that a rotor of this width is in the box.")
               .optional())
      .add(choice("Outside", {"Error", "Hold"},
                  "What a place or time outside of the box means: an error, or the nearest known "
                  "velocity.")
               .optional("Error"))
      .add_all(wind_axes_schema());
}

SharedFlow make_box(const Options& options, TurbulenceGrid grid) {
  return std::make_shared<Box>(options, std::move(grid));
}

}  // namespace culm::flow
