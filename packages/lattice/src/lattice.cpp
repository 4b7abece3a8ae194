#include <culm/lattice/lattice.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace culm::lattice {
namespace {

constexpr double far_chords = 1e4;  // length of a straight wake

Points sum(const Points& a, double factor, const Points& b) {
  Points result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result.set(i, a.at(i) + factor * b.at(i));
  return result;
}

Points mean(const Points& a, const Points& b) {
  Points result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result.set(i, 0.5 * (a.at(i) + b.at(i)));
  return result;
}

// Values at collocation points carried to middles of segments. The middle of a segment along the
// span lies between two collocation points of its strip, the leading one ahead of the first.
Points to_middles(const BoundLattice& bound, const Points& at_collocation) {
  Points result(bound.num_segments());
  for (const Panelling& s : bound.surfaces()) {
    const auto [m, n] = s.panels;
    const auto value = [&](int i, int j) { return at_collocation.at(s.ring(i, j)); };
    for (int j = 0; j < n; ++j) {
      for (int i = 1; i < m; ++i) {
        result.set(s.across(i, j), 0.5 * (value(i - 1, j) + value(i, j)));
      }
      result.set(s.across(0, j), m > 1 ? Vec3(1.5 * value(0, j) - 0.5 * value(1, j)) : value(0, j));
      result.set(s.across(m, j), value(m - 1, j));
    }
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j <= n; ++j) {
        result.set(s.along(i, j),
                   0.5 * (value(i, j > 0 ? j - 1 : 0) + value(i, j < n ? j : n - 1)));
      }
    }
  }
  return result;
}

}  // namespace

FluidState Lattice::initial_state() const {
  const auto rings = static_cast<Eigen::Index>(bound_.num_rings());
  const bool at_segments = setting_.forces == ForceRule::joukowski;
  return {Eigen::VectorXd::Zero(rings),
          Points(at_segments ? bound_.num_segments() : bound_.num_rings()),
          Wake(bound_, setting_.rows, setting_.core)};
}

Points Lattice::flow_at(const Points& places, double time) const {
  std::vector<Vec3> at(places.size()), velocities(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) at[i] = places.at(i);
  flow_->velocities(at, time, velocities);
  Points result(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) result.set(i, velocities[i]);
  return result;
}

Points Lattice::unit_normals(const Points& grid) const {
  Points normals = bound_.areas(grid);
  for (std::size_t i = 0; i < normals.size(); ++i) normals.set(i, normals.at(i).normalized());
  return normals;
}

Points Lattice::force_points(const Points& grid) const {
  return setting_.forces == ForceRule::joukowski ? bound_.segment_middles(bound_.corners(grid))
                                                 : bound_.collocation_points(grid);
}

Lattice::ComingWake Lattice::begin_step(const FluidState& state, const Points& start,
                                        const Points& expected, double time_start,
                                        double time_end) const {
  ComingWake coming{state.wake, {}, {}};
  const Points corners = bound_.corners(start);
  const Points edges = bound_.edge_points(corners);
  const double middle = 0.5 * (time_start + time_end);
  Points at_edges = flow_at(edges, middle);
  Points at_lines = flow_at(state.wake.lines(), middle);
  if (setting_.wake == WakeMotion::free) {
    const Segments segments = bound_.segments(corners);
    at_edges =
        sum(at_edges, 1.0, induced_at(edges, segments, state.circulation, state.wake, edges));
    at_lines = sum(at_lines, 1.0,
                   induced_at(state.wake.lines(), segments, state.circulation, state.wake, edges));
  }
  coming.wake.advance(time_end - time_start, edges, at_edges, at_lines,
                      bound_.edge_circulation(state.circulation));
  const Wake::Sheet far = coming.wake.far_part();
  coming.at_collocation.resize(bound_.num_rings());
  bound_.add_induced(far.segments, far.strengths, bound_.collocation_points(expected),
                     coming.at_collocation);
  // carried over, because as many more points would cost twice as much again
  coming.at_forces = setting_.forces == ForceRule::joukowski
                         ? to_middles(bound_, coming.at_collocation)
                         : coming.at_collocation;
  return coming;
}

void Lattice::add_row(const Points& from, const Points& to, std::size_t strip, const Points& places,
                      const Points& normals, std::span<double> column) const {
  std::vector<double> strengths(bound_.num_strips(), 0.0);
  strengths[strip] = 1.0;
  Wake row(bound_, 1, setting_.core);
  row.make_straight(to, std::move(strengths));
  for (const Wake::Sheet& sheet : {row.near_part(from), row.far_part()}) {
    for (std::size_t k = 0; k < sheet.segments.size(); ++k) {
      if (sheet.strengths[k] == 0.0) continue;
      bound_.add_induced_normal(sheet.segments, k, sheet.strengths[k], places, normals, column);
    }
  }
}

// No flow through the collocation points, with what moves there relative to them. The circulation
// of a straight wake is unknown as well: it is that of the rings at the edge.
void Lattice::solve(const Segments& segments, const Points& grid, const Wake* straight,
                    const Points& edges, FluidResult& result) const {
  const Points places = bound_.collocation_points(grid);
  const Points normals = unit_normals(grid);
  const auto rings = static_cast<Eigen::Index>(bound_.num_rings());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rings, rings);
  bound_.add_influence(segments, places, normals, matrix);
  if (straight != nullptr) {
    for (const Panelling& s : bound_.surfaces()) {
      for (int j = 0; j < s.panels.span; ++j) {
        const auto column = static_cast<Eigen::Index>(s.ring(s.panels.chord - 1, j));
        add_row(edges, straight->lines(), s.strip(j), places, normals,
                {matrix.col(column).data(), bound_.num_rings()});
      }
    }
  }
  Eigen::VectorXd right(rings);
  for (Eigen::Index k = 0; k < rings; ++k) {
    const auto at = static_cast<std::size_t>(k);
    right[k] = -result.at_collocation.at(at).dot(normals.at(at));
  }
  result.influence.compute(matrix);
  result.circulation = result.influence.solve(right);
}

// By the bound rings and by a whole wake.
Points Lattice::induced_at(const Points& places, const Segments& segments,
                           const Eigen::VectorXd& circulation, const Wake& wake,
                           const Points& edges) const {
  Points result(places.size());
  bound_.add_induced(segments, bound_.strengths(circulation), places, result);
  for (const Wake::Sheet& sheet : {wake.near_part(edges), wake.far_part()}) {
    bound_.add_induced(sheet.segments, sheet.strengths, places, result);
  }
  return result;
}

FluidResult Lattice::step(const FluidState& state, const ComingWake& coming,
                          const GridStep& grid) const {
  const Points corners = bound_.corners(grid.end);
  const Segments segments = bound_.segments(corners);
  const Points edges = bound_.edge_points(corners);
  const Wake::Sheet near = coming.wake.near_part(edges);

  const Points places = bound_.collocation_points(grid.end);
  FluidResult result;
  result.at_collocation = sum(sum(flow_at(places, grid.time_end), 1.0, coming.at_collocation), -1.0,
                              bound_.collocation_points(grid.end_velocity));
  bound_.add_induced(near.segments, near.strengths, places, result.at_collocation);
  solve(segments, grid.end, nullptr, edges, result);

  result.induced = coming.at_forces;
  const Points forced = force_points(grid.end);
  bound_.add_induced(segments, bound_.strengths(result.circulation), forced, result.induced);
  bound_.add_induced(near.segments, near.strengths, forced, result.induced);

  const double step = grid.time_end - grid.time_start;
  const Points middle = mean(grid.start, grid.end);
  const Points moved = sum(grid.end, -1.0, grid.start);
  Points wind = flow_at(force_points(middle), 0.5 * (grid.time_start + grid.time_end));
  wind = sum(wind, 1.0, mean(state.induced, result.induced));
  result.at_forces = sum(wind, -1.0 / step, force_points(moved));
  result.forces = forces(middle, result.at_forces, 0.5 * (state.circulation + result.circulation),
                         (result.circulation - state.circulation) / step);
  return result;
}

double Lattice::small_way(const Points& change) const {
  double largest = 0.0, chord = bound_.surfaces().front().chord;
  for (std::size_t i = 0; i < change.size(); ++i) largest = std::max(largest, change.at(i).norm());
  for (const Panelling& s : bound_.surfaces()) chord = std::min(chord, s.chord);
  return largest > 0.0 ? 1e-5 * chord / largest : 0.0;
}

Points Lattice::change_of_normals(const Points& grid, const Points& change) const {
  const double h = small_way(change);
  if (h == 0.0) return Points(bound_.num_rings());
  Points difference =
      sum(unit_normals(sum(grid, h, change)), -1.0, unit_normals(sum(grid, -h, change)));
  for (std::size_t i = 0; i < difference.size(); ++i) {
    difference.set(i, difference.at(i) / (2.0 * h));
  }
  return difference;
}

// A dG = -w . dn + n . dv; what forces are made of changes with it. These have few terms, so
// differences give their derivative to rounding.
Points Lattice::change_of_forces(const FluidResult& result, const Eigen::VectorXd& before,
                                 const GridStep& grid, const Points& change) const {
  const double step = grid.time_end - grid.time_start;
  const double share = step > 0.0 ? 0.5 : 1.0;  // of the end, where forces act
  const double rate = step > 0.0 ? 1.0 / step : 0.0;
  const double h = small_way(change);
  if (h == 0.0) return Points(change.size());

  const Points normals = unit_normals(grid.end);
  const Points turned = change_of_normals(grid.end, change);
  const Points moved = bound_.collocation_points(change);
  Eigen::VectorXd right(result.circulation.size());
  for (Eigen::Index k = 0; k < right.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    right[k] = -result.at_collocation.at(at).dot(turned.at(at)) +
               2.0 * rate * moved.at(at).dot(normals.at(at));
  }
  const Eigen::VectorXd circulation = result.influence.solve(right);

  const Points middle = mean(grid.start, grid.end);
  const Points motion = force_points(change);
  const Eigen::VectorXd mean_circulation =
      step > 0.0 ? Eigen::VectorXd(0.5 * (before + result.circulation)) : result.circulation;
  const Eigen::VectorXd growth = step > 0.0 ? Eigen::VectorXd(rate * (result.circulation - before))
                                            : Eigen::VectorXd::Zero(right.size());
  const auto beside = [&](double way) {
    return forces(sum(middle, share * way, change), sum(result.at_forces, -rate * way, motion),
                  mean_circulation + share * way * circulation, growth + rate * way * circulation);
  };
  Points difference = sum(beside(h), -1.0, beside(-h));
  for (std::size_t i = 0; i < difference.size(); ++i) {
    difference.set(i, difference.at(i) / (2.0 * h));
  }
  return difference;
}

FluidState Lattice::state_after(const FluidResult& result, Wake wake) {
  return {result.circulation, result.induced, std::move(wake)};
}

Points Lattice::far_line(const Points& edges, double time) const {
  const Points wind = flow_at(edges, time);
  Points far(edges.size());
  for (const Panelling& s : bound_.surfaces()) {
    for (int j = 0; j <= s.panels.span; ++j) {
      const std::size_t at = s.edge_point(j);
      // no wind leaves no wake: normalized() of zero is zero
      far.set(at, edges.at(at) + far_chords * s.chord * wind.at(at).normalized());
    }
  }
  return far;
}

FluidResult Lattice::steady(const Points& grid, double time) const {
  const Points corners = bound_.corners(grid);
  const Segments segments = bound_.segments(corners);
  const Points edges = bound_.edge_points(corners);
  Wake wake(bound_, 1, setting_.core);
  wake.make_straight(far_line(edges, time), std::vector<double>(bound_.num_strips(), 0.0));
  FluidResult result;
  result.at_collocation = flow_at(bound_.collocation_points(grid), time);
  solve(segments, grid, &wake, edges, result);
  wake.make_straight(wake.lines(), bound_.edge_circulation(result.circulation));
  const Points places = force_points(grid);
  result.induced = induced_at(places, segments, result.circulation, wake, edges);
  result.at_forces = sum(flow_at(places, time), 1.0, result.induced);
  result.forces = forces(grid, result.at_forces, result.circulation,
                         Eigen::VectorXd::Zero(result.circulation.size()));
  return result;
}

FluidState Lattice::steady_state(const FluidResult& result, const Points& grid, double time) const {
  Wake wake(bound_, setting_.rows, setting_.core);
  wake.make_straight(far_line(bound_.edge_points(bound_.corners(grid)), time),
                     bound_.edge_circulation(result.circulation));
  return state_after(result, std::move(wake));
}

}  // namespace culm::lattice
