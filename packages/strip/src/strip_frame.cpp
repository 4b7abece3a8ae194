#include <culm/base/error.hpp>
#include <culm/strip/strip_load.hpp>

#include "section_map.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

namespace culm::strip {

// Where the frame turns from the first, this is told before anything is written.
void StripLoad::stand_in(const model::SteadyRotation& frame, Where where) {
  frame_ = &frame;
  frame_where_ = std::move(where);
  model::State start;
  start.prev = nodes_.reference();
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    refuse_wind_across_frame(i, start, Stencil::statics());
  }
}

// Seen from the frame, the wind must be the same when the frame has turned on.
void StripLoad::refuse_wind_across_frame(std::size_t number, const model::State& state,
                                         const Stencil& stencil) const {
  constexpr int sides = 8;
  constexpr double same = 1e-6;
  if (frame_->speed(state, stencil) == 0.0) return;
  const Station& station = stations_[number];
  const Vec3 place = vectors_of(station, state.prev).col(0);
  const double time = load::time_of(state, stencil);
  const Vec3 wind = flow_->velocity(place, time);
  for (int side = 1; side < sides; ++side) {
    const Mat3 turn =
        Eigen::AngleAxisd(2.0 * std::numbers::pi * side / sides, frame_->axis()).matrix();
    const Vec3 there = turn.transpose() *
                       flow_->velocity(frame_->point() + turn * (place - frame_->point()), time);
    if ((there - wind).norm() <= same * std::max(wind.norm(), there.norm())) continue;
    throw InputError(
        frame_where_,
        fmt::format("{} stands in a rotating frame, but its wind is not the same from all sides: "
                    "at station {} it is {{{:.4g}, {:.4g}, {:.4g}}} m/s in the frame, and "
                    "{{{:.4g}, {:.4g}, {:.4g}}} after {} degrees.\nTake a wind along the axis that "
                    "does not depend on the azimuth, or a motion in time without the frame",
                    effect().quoted(), number, wind[0], wind[1], wind[2], there[0], there[1],
                    there[2], 360 / sides * side));
  }
}

}  // namespace culm::strip
