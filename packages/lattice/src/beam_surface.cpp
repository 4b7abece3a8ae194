#include "surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::lattice {
namespace {

// Chords by the fraction of the length, linear between positions.
class ChordTable {
 public:
  ChordTable(const Options& options, InputIssues& issues) {
    if (options.has("Chord") == options.has("Chords")) {
      issues.add(options.where(), "a surface on a beam needs one of 'Chord' and 'Chords'");
      return;
    }
    if (options.has("Chord")) {
      positions_ = {0.0};
      chords_ = {options.number("Chord")};
      return;
    }
    if (!options.has("Positions")) {
      issues.add(options.where("Chords"), "'Chords' needs 'Positions'");
      return;
    }
    positions_ = options.numbers("Positions");
    chords_ = options.numbers("Chords");
    if (positions_.size() != chords_.size()) {
      issues.add(options.where("Chords"),
                 fmt::format("must have one number for each of {} positions, got {}",
                             positions_.size(), chords_.size()));
    } else if (!std::ranges::is_sorted(positions_, std::less_equal<>())) {
      issues.add(options.where("Positions"), "must ascend");
    } else {
      return;
    }
    chords_.clear();
  }

  bool is_sound() const { return !chords_.empty(); }
  double at(double fraction) const {
    const auto above = std::ranges::upper_bound(positions_, fraction);
    if (above == positions_.begin()) return chords_.front();
    if (above == positions_.end()) return chords_.back();
    const auto k = static_cast<std::size_t>(above - positions_.begin());
    const double share = (fraction - positions_[k - 1]) / (positions_[k] - positions_[k - 1]);
    return chords_[k - 1] + share * (chords_[k] - chords_[k - 1]);
  }

 private:
  std::vector<double> positions_, chords_;
};

}  // namespace

std::optional<SurfaceGrid> beam_surface(const Options& options, const model::Structure& beam,
                                        const std::vector<double>& stations,
                                        model::BuildContext& context) {
  for (const char* of_shells : {"Leading Edge", "Trailing Edge"}) {
    if (!options.has(of_shells)) continue;
    context.issues.add(options.where(of_shells), "structure '" + beam.name +
                                                     "' is a beam: 'Chord', 'Nose' and 'Axis At' "
                                                     "say where its edges are");
    return {};
  }
  const ChordTable chords(options, context.issues);
  const Eigen::Vector2d nose(options.numbers("Nose")[0], options.numbers("Nose")[1]);
  if (nose.norm() == 0.0) {
    context.issues.add(options.where("Nose"), "must not be zero");
    return {};
  }
  if (!chords.is_sound()) return {};
  const Eigen::Vector2d forward = nose.normalized();
  const Eigen::Vector2d up(-forward.y(), forward.x());  // chord x span
  SurfaceGrid grid{panels_of(options), {}};
  // panels have the slope of the mean line 4 h xi (1 - xi) at their collocation points, not the
  // mean one: so the lift of the camber does not miss a share of 1/m
  const double ahead = 0.5 / grid.panels.chord;
  for (int i = 0; i <= grid.panels.chord; ++i) {
    const double xi = static_cast<double>(i) / grid.panels.chord;
    for (const double station : stations) {
      const double chord = chords.at(station);
      const Eigen::Vector2d offset =
          chord * ((options.number("Axis At") - xi) * forward +
                   4.0 * options.number("Camber") * xi * (1.0 - xi - ahead) * up);
      model::Marker marker = *model::marker_at_fraction(beam, station);
      marker.offset += Vec3(offset.x(), offset.y(), 0.0);
      grid.points.push_back(std::move(marker));
    }
  }
  return grid;
}

}  // namespace culm::lattice
