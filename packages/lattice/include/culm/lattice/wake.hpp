/// The vortex sheets that leave trailing edges.
#pragma once

#include <culm/lattice/bound_lattice.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace culm::lattice {

/// Radii of the cores of wakes.
struct WakeCore {
  double width = 0.1;   ///< at the trailing edge, over the smaller side of a panel
  double growth = 0.0;  ///< delta nu in r_c^2 = r_0^2 + 4 1.25643 delta nu t [m^2/s]
};

/// Rows of rings behind all trailing edges. Row 0 is the newest: it reaches from the edges, which
/// the wake does not hold, to line 0; row k from line k - 1 to line k. Rows keep their circulation
/// and their lines move. @source Katz, Plotkin, Low-Speed Aerodynamics, 13.12
class Wake {
 public:
  Wake() = default;
  Wake(const BoundLattice& lattice, int max_rows, WakeCore core);

  int rows() const { return static_cast<int>(ages_.size()); }
  int max_rows() const { return max_rows_; }
  const Points& lines() const { return lines_; }  ///< line after line, by edge point
  const std::vector<double>& circulation() const { return circulation_; }  ///< row by row, by strip
  const std::vector<double>& ages() const { return ages_; }                ///< of lines [s]

  /// One row from the edges to `far`: a wake that has always been as it is.
  void make_straight(const Points& far, std::vector<double> circulation);
  /// Lines and edges move with their velocities, and a new row of `circulation` is spanned between
  /// the edges to come and where they are now. Beyond the largest number of rows the oldest is
  /// lost.
  void advance(double step, const Points& edges, const Points& edge_velocities,
               const Points& line_velocities, const std::vector<double>& circulation);

  /// Segments with their strengths, in one order for all steps.
  struct Sheet {
    Segments segments;
    std::vector<double> strengths;
  };
  /// Segments that touch the edges, of the newest row; none if there is no row. Those on the edges
  /// have the core of the bound ones that they meet.
  Sheet near_part(const Points& edges) const;
  /// All others.
  Sheet far_part() const;
  /// Numbers that save writes, whatever the number of rows.
  std::size_t memory_size() const;
  void save(std::span<double> memory) const;
  void restore(std::span<const double> memory);

 private:
  double core(const Panelling& surface, double age) const;
  double strength(int row, std::size_t strip) const;
  std::size_t line_point(int line, std::size_t edge_point) const {
    return static_cast<std::size_t>(line) * num_edge_points_ + edge_point;
  }

  std::vector<Panelling> surfaces_;
  std::size_t num_edge_points_ = 0, num_strips_ = 0;
  int max_rows_ = 0;
  WakeCore core_;
  Points lines_;
  std::vector<double> circulation_;
  std::vector<double> ages_;
};

}  // namespace culm::lattice
