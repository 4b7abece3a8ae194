/// Smooth curve through points, by arc length.
#pragma once

#include <culm/math/types.hpp>

#include <vector>

namespace culm {

/// Natural cubic spline through points in space: curvature is continuous and vanishes at the ends.
/// Its parameter is the length of the chords; places on it are given by arc length s [m].
class Spline {
 public:
  /// @pre at least two points, neighbours differ
  explicit Spline(std::vector<Vec3> points);

  /// Length of the whole curve [m].
  double length() const { return arc_lengths_.back(); }
  /// Arc length from the start to each point [m].
  const std::vector<double>& arc_lengths() const { return arc_lengths_; }

  Vec3 position(double s) const;
  /// Unit vector.
  Vec3 tangent(double s) const;

 private:
  // A piece between two points and a place on it, u from 0 to its chord.
  struct Place {
    std::size_t piece;
    double u;
  };
  Place find(double s) const;
  Vec3 slope(const Place& at) const;  // dx/du
  double arc_length(std::size_t piece, double from, double to) const;

  std::vector<Vec3> points_;
  std::vector<double> chords_;    // of the pieces [m]
  std::vector<Vec3> curvatures_;  // d2x/du2 at the points [1/m]
  std::vector<double> arc_lengths_;
};

}  // namespace culm
