#include <culm/lattice/lattice_load.hpp>
#include <culm/load/slot_kernel.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace culm::lattice {
namespace {

using Motion = model::ItemMotion<4>;

Points reference_grid(const std::vector<SurfaceGrid>& surfaces, const model::NodeTable& nodes) {
  Points points;
  for (const SurfaceGrid& surface : surfaces) {
    for (const model::Marker& marker : surface.points) {
      Vec3 place = Vec3::Zero();
      for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
        const auto slots = model::NodeTable::slots(nodes.reference(), marker.nodes[a]);
        place += marker.weights[a] * (slots.col(0) + slots.rightCols<3>() * marker.offset);
      }
      points.push_back(place);
    }
  }
  return points;
}

std::vector<Panels> panels_of(const std::vector<SurfaceGrid>& surfaces) {
  std::vector<Panels> panels;
  for (const SurfaceGrid& surface : surfaces) panels.push_back(surface.panels);
  return panels;
}

// Integral of sqrt(1 - x^2) from -1 to x.
double half_disc(double x) {
  return 0.5 * (x * std::sqrt(std::max(0.0, 1.0 - x * x)) + std::asin(x)) + 0.25 * std::numbers::pi;
}

// At which flows leave thin surfaces.
constexpr double good_angle = std::numbers::pi / 12.0;
// Of the wind across a mirror, over that which the surfaces feel.
constexpr double good_crossing = 0.02;
// `range_used` of a wind that crosses it; angles are less.
constexpr double through_mirror = 100.0;

bool is_finite(const Points& points) {
  const auto finite = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  };
  return finite(points.x) && finite(points.y) && finite(points.z);
}

}  // namespace

LatticeLoad::LatticeLoad(model::Effect effect, const model::NodeTable& nodes,
                         std::vector<SurfaceGrid> surfaces, std::optional<Vec3> mirror,
                         flow::SharedFlow flow, LatticeSetting setting, LatticeTangent tangent)
    : MemorylessBatch(std::move(effect)),
      FluidForce(*flow),
      nodes_(nodes),
      lattice_(
          BoundLattice(panels_of(surfaces), reference_grid(surfaces, nodes), std::move(mirror)),
          flow, setting),
      tangent_(tangent),
      density_(flow->density()),
      accepted_(lattice_.initial_state()),
      accepted_forces_(lattice_.bound().num_points()) {
  add_items(surfaces);
  add_carriers();
  compute_apparent_masses();
}

void LatticeLoad::add_items(const std::vector<SurfaceGrid>& surfaces) {
  std::map<std::vector<int>, std::size_t> known;
  std::size_t point = 0;
  for (const SurfaceGrid& surface : surfaces) {
    for (const model::Marker& marker : surface.points) {
      const auto [found, is_new] = known.emplace(marker.nodes, items_.size());
      if (is_new) items_.push_back({marker.nodes, {}, {}});
      Item& item = items_[found->second];
      Eigen::VectorXd factors(4 * static_cast<Eigen::Index>(marker.nodes.size()));
      for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
        factors.segment<4>(4 * static_cast<Eigen::Index>(a)) << marker.weights[a],
            marker.weights[a] * marker.offset;
      }
      item.points.push_back(point++);
      item.factors.push_back(std::move(factors));
    }
  }
}

// Half of pi rho b^2 per span, spread along the chord as sqrt(1 - xi^2): a point of the grid takes
// what lies nearer to it than to its neighbours.
void LatticeLoad::compute_apparent_masses() {
  const Points reference = grid(nodes_.reference());
  apparent_mass_.assign(reference.size(), 0.0);
  for (const Panelling& s : lattice_.bound().surfaces()) {
    const auto [m, n] = s.panels;
    for (int j = 0; j <= n; ++j) {
      const double chord = (reference.at(s.point(m, j)) - reference.at(s.point(0, j))).norm();
      double width = 0.0;
      for (const int side : {j - 1, j + 1}) {
        if (side < 0 || side > n) continue;
        width += 0.25 * (reference.at(s.point(0, side)) - reference.at(s.point(0, j)) +
                         reference.at(s.point(m, side)) - reference.at(s.point(m, j)))
                            .norm();
      }
      for (int i = 0; i <= m; ++i) {
        const double begin = std::max(-1.0, (2.0 * i - 1.0) / m - 1.0);
        const double end = std::min(1.0, (2.0 * i + 1.0) / m - 1.0);
        const double share = half_disc(end) - half_disc(begin);  // of pi / 2
        apparent_mass_[s.point(i, j)] = density_ * 0.25 * chord * chord * width * share;
      }
    }
  }
}

std::vector<int> LatticeLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  const auto at = static_cast<std::size_t>(item);
  return blocks_of(is_coupling(item) ? carriers_ : items_[at].nodes, unknowns);
}

Points LatticeLoad::grid(const model::Coordinates& q) const {
  Points points(lattice_.bound().num_points());
  for (const Item& item : items_) {
    for (std::size_t k = 0; k < item.points.size(); ++k) {
      Vec3 place = Vec3::Zero();
      for (std::size_t a = 0; a < item.nodes.size(); ++a) {
        place += model::NodeTable::slots(q, item.nodes[a]) *
                 item.factors[k].segment<4>(4 * static_cast<Eigen::Index>(a));
      }
      points.set(item.points[k], place);
    }
  }
  return points;
}

void LatticeLoad::prepare(const model::State& state, const Stencil& stencil) {
  evaluated_.resize(0);
  knows_stiffness_ = false;
  linearises_ = stencil.frees_states;
  step_ = stencil.inertia > 0.0 ? stencil.step : 0.0;  // a linearisation is about the steady flow
  if (step_ == 0.0) return;
  start_ = grid(state.prev);
  start_velocity_ = grid(state.velocity);  // linear, so rates map like places
  Points expected = start_;
  for (std::size_t i = 0; i < expected.size(); ++i) expected.add(i, step_ * start_velocity_.at(i));
  coming_ = lattice_.begin_step(accepted_, start_, expected, state.time - step_, state.time);
}

GridStep LatticeLoad::step_to(const model::State& state) const {
  GridStep motion{start_, grid(state.next), start_velocity_, state.time - step_, state.time};
  for (std::size_t i = 0; i < start_.size(); ++i) {
    motion.end_velocity.set(
        i, 2.0 / step_ * (motion.end.at(i) - start_.at(i)) - start_velocity_.at(i));
  }
  return motion;
}

// Newton, work and acceptance ask for the same configuration.
const FluidResult& LatticeLoad::result_at(const model::State& state) const {
  if (std::ranges::equal(evaluated_, state.next)) return result_;
  if (step_ == 0.0) {
    result_ = lattice_.steady(grid(state.next), lattice_.flow().time_at_level(state.time));
  } else {
    result_ = lattice_.step(accepted_, coming_, step_to(state));
  }
  evaluated_ = state.next;
  return result_;
}

void LatticeLoad::accept(model::State& state) {
  const FluidResult& result = result_at(state);
  const Points end = grid(state.next);
  accepted_forces_ = result.forces;
  if (step_ == 0.0) {
    resultant_ = resultant_of(result.forces, end);
    const double time = lattice_.flow().time_at_level(state.time);
    range_used_ = used_at(end, Points(end.size()), time);
    accepted_ = lattice_.steady_state(result, end, time);
    return;
  }
  Points middle = start_, velocity = start_;
  for (std::size_t i = 0; i < middle.size(); ++i) {
    middle.set(i, 0.5 * (start_.at(i) + end.at(i)));
    velocity.set(i, (end.at(i) - start_.at(i)) / step_);
  }
  resultant_ = resultant_of(result.forces, middle);
  range_used_ = used_at(middle, velocity, state.time - 0.5 * step_);
  accepted_ = Lattice::state_after(result, coming_.wake);
}

std::optional<flow::FluidForce::Resultant> LatticeLoad::resultant() const {
  if (!resultant_ || counts()) return resultant_;
  return Resultant{};
}

// The largest angle between the undisturbed wind and the surfaces at their leading edges; and of
// the wind with the plane of the mirror, behind which it would blow the other way.
double LatticeLoad::used_at(const Points& grid, const Points& velocity, double time) const {
  double largest = 0.0, crossing = 0.0;
  const std::optional<Vec3>& mirror = lattice_.bound().mirror();
  for (const Panelling& s : lattice_.bound().surfaces()) {
    for (int j = 0; j <= s.panels.span; ++j) {
      const std::size_t point = s.point(0, j);
      const Vec3 wind = lattice_.flow().velocity(grid.at(point), time);
      const Vec3 relative = wind - velocity.at(point);
      const Vec3 chord = (grid.at(s.point(s.panels.chord, j)) - grid.at(point)).normalized();
      largest = std::max(
          largest, std::atan2(std::abs(relative.dot(normal_at(point, grid))), relative.dot(chord)));
      if (mirror) crossing = std::max(crossing, std::abs(wind.dot(*mirror)) / relative.norm());
    }
  }
  return crossing > good_crossing ? through_mirror : largest / good_angle;
}

std::string LatticeLoad::range_warning(double used) const {
  if (used == through_mirror) {
    return effect().quoted() +
           ": the wind blows through its 'Mirror', behind which it would blow the other way: what "
           "is "
           "computed is no half of anything. Take a wind along that plane, or the whole without it";
  }
  const double degrees = used * good_angle * 180.0 / std::numbers::pi;
  if (degrees > 90.0) {
    return effect().quoted() +
           ": the wind comes from behind, onto the edges where wakes begin; 'Nose', or which edge "
           "is "
           "the leading one, says where it should come from";
  }
  return fmt::format(
      "{}: the wind meets surfaces at angles up to {:.3g} degrees: its flow never leaves them, "
      "real "
      "ones do from some 15 degrees on",
      effect().quoted(), degrees);
}

std::string LatticeLoad::left_out_of_modes() const {
  if (tangent_ == LatticeTangent::whole) return "";
  return effect().quoted() +
         ": linear analyses see the forces of the steady flow about the state, not how they change "
         "with motion: there is no stiffness, damping or mass of its air, hence no flutter. "
         "'Tangent' = Whole brings them, and a motion in time knows all of them";
}

flow::FluidForce::Resultant LatticeLoad::resultant_of(const Points& forces, const Points& places) {
  Resultant sum;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    sum.force += forces.at(i);
    sum.moment += places.at(i).cross(forces.at(i));
  }
  return sum;
}

Verdict LatticeLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                              model::Target& target) {
  const bool whole = tangent_ == LatticeTangent::whole;
  if (want == Want::mass) {
    return whole && linearises_ ? assemble_coupling(air_at(state).mass, state, stencil, target)
                                : Verdict::ok;
  }
  const Points& forces = result_at(state).forces;
  if (!is_finite(forces)) return Verdict::not_finite;
  const bool tangent = want == Want::residual_and_tangent;
  Verdict verdict = assemble_items([&](auto space, std::size_t i) {
    if (is_coupling(placement().items[i])) return Verdict::ok;
    return assemble_item<decltype(space)>(i, state, stencil, tangent, forces, target);
  });
  if (!whole || !tangent) return verdict;
  if (step_ == 0.0 || !knows_stiffness_) find_stiffness(state);
  verdict = worse(verdict, assemble_coupling(stiffness_, state, stencil, target));
  const bool moves_slowly = step_ == 0.0 && stencil.step > 0.0;  // about a steady state
  if (!moves_slowly) return verdict;
  return worse(verdict,
               assemble_coupling(air_at(state).damping / stencil.step, state, stencil, target));
}

// Of the columns of panels around a grid point, at its place along the chord.
Vec3 LatticeLoad::normal_at(std::size_t point, const Points& grid) const {
  for (const Panelling& s : lattice_.bound().surfaces()) {
    const auto [m, n] = s.panels;
    if (point > s.point(m, n)) continue;
    const auto at = static_cast<int>(point - s.first_point);
    const int i = at / (n + 1), j = at % (n + 1);
    const Vec3 along =
        grid.at(s.point(std::min(i + 1, m), j)) - grid.at(s.point(std::max(i - 1, 0), j));
    const Vec3 across =
        grid.at(s.point(i, std::min(j + 1, n))) - grid.at(s.point(i, std::max(j - 1, 0)));
    return along.cross(across).normalized();
  }
  return Vec3::Zero();
}

// r_s = -sum T_s F      dr_s / dq_t = sum T_s T_t m n n^T iota
template <class Space>
Verdict LatticeLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                   bool tangent, const Points& forces,
                                   model::Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const Motion motion(nodes_, item.nodes, state, stencil.theta);
  Motion::Slots slot_forces = Motion::Slots::Zero(3, motion.mid.cols());
  for (std::size_t k = 0; k < item.points.size(); ++k) {
    slot_forces -= forces.at(item.points[k]) * item.factors[k].transpose();
  }
  const bool has_inertia =
      tangent && stencil.inertia > 0.0 && tangent_ == LatticeTangent::apparent_mass;
  std::vector<Mat3> inertia;
  if (has_inertia) {
    for (const std::size_t point : item.points) {
      const Vec3 n = normal_at(point, start_);
      inertia.push_back(stencil.inertia * apparent_mass_[point] * n * n.transpose());
    }
  }
  const auto num_nodes = static_cast<int>(item.nodes.size());
  for (int a = 0; a < num_nodes; ++a) {
    const Vec<12> slots = Mat<3, 4>(slot_forces.middleCols<4>(4 * a)).reshaped();
    const auto& arms_mid = motion.arms_mid[static_cast<std::size_t>(a)];
    Vec<W> residual;
    Space::reduce_rows(slots, arms_mid, residual);
    target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
    placement().scatter.add_residual(i, a, residual.data(), target);
    if (!tangent) continue;
    for (int b = 0; b < num_nodes; ++b) {
      const auto& arms_next = motion.arms_next[static_cast<std::size_t>(b)];
      RowMat<W, W> block = RowMat<W, W>::Zero();
      if (has_inertia) {
        Mat<12, 12> K = Mat<12, 12>::Zero();
        for (std::size_t k = 0; k < inertia.size(); ++k) {
          const Eigen::VectorXd& T = item.factors[k];
          for (int s = 0; s < 4; ++s) {
            for (int t = 0; t < 4; ++t) {
              K.block<3, 3>(3 * s, 3 * t) += T[4 * a + s] * T[4 * b + t] * inertia[k];
            }
          }
        }
        load::add_slot_tangent<Space>(K, arms_mid, arms_next, block);
      }
      if (a == b) {
        Space::add_turning(slots.reshaped<Eigen::ColMajor>(3, 4), arms_next, stencil.theta, block);
      }
      placement().scatter.add_tangent(i, a, b, block, target);
    }
  }
  return Verdict::ok;
}

model::StepWork LatticeLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const Points& forces = result_at(state).forces;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i] || is_coupling(placement().items[i])) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const Motion motion(nodes_, item.nodes, state, stencil.theta);
    Motion::Slots slot_forces = Motion::Slots::Zero(3, motion.mid.cols());
    for (std::size_t k = 0; k < item.points.size(); ++k) {
      slot_forces += forces.at(item.points[k]) * item.factors[k].transpose();
    }
    load::add_item_work(slot_forces, motion, item.nodes, state, true, work);
  }
  return work;
}

std::size_t LatticeLoad::memory_size() const {
  return static_cast<std::size_t>(accepted_.circulation.size()) + 3 * accepted_.induced.size() +
         3 * accepted_forces_.size() + 7 + accepted_.wake.memory_size();
}

bool LatticeLoad::counts() const {
  const auto& items = placement().items;
  const auto first = std::ranges::find(items, 0);
  return first != items.end() && placement().owned[static_cast<std::size_t>(first - items.begin())];
}

void LatticeLoad::save(model::Items which, std::span<double> memory) const {
  if (which == model::Items::owned && !counts()) return;
  auto out = memory.begin();
  const auto put = [&out](const auto& values) {
    out = std::copy(values.begin(), values.end(), out);
  };
  put(accepted_.circulation);
  for (const Points* points : {&accepted_.induced, &accepted_forces_}) {
    put(points->x);
    put(points->y);
    put(points->z);
  }
  const Resultant known = resultant_.value_or(Resultant{});
  put(known.force);
  put(known.moment);
  *out = resultant_ ? 1.0 : 0.0;
  accepted_.wake.save(memory.last(accepted_.wake.memory_size()));
}

void LatticeLoad::restore(std::span<const double> memory) {
  auto in = memory.begin();
  const auto take = [&in](auto& values) {
    const auto count = static_cast<std::ptrdiff_t>(values.size());
    std::copy(in, in + count, values.begin());
    in += count;
  };
  take(accepted_.circulation);
  for (Points* points : {&accepted_.induced, &accepted_forces_}) {
    take(points->x);
    take(points->y);
    take(points->z);
  }
  Resultant known;
  take(known.force);
  take(known.moment);
  resultant_.reset();
  if (*in != 0.0) resultant_ = known;
  accepted_.wake.restore(memory.last(accepted_.wake.memory_size()));
}

}  // namespace culm::lattice
