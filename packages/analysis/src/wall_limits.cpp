#include "wall_limits.hpp"

#include <culm/model/layer_source.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <span>
#include <vector>

namespace culm::analysis {
namespace {

using model::Coordinates;
using States = std::vector<model::LayerState>;
constexpr std::size_t heights = model::layer_heights.size();

// The corners of a cell, and the axes of its middle: two in the plane, the third normal to it.
struct Corners {
  Corners(const model::Cell& cell, const Coordinates& q) : nodes(cell.nodes) {
    const auto at = [&](std::size_t a) {
      return Vec3(model::NodeTable::slots(q, nodes[a]).col(0));
    };
    const Vec3 diagonals = (at(2) - at(0)).cross(at(3) - at(1));
    axes.col(2) = diagonals.normalized();
    axes.col(0) = (at(1) - at(0) - axes.col(2).dot(at(1) - at(0)) * axes.col(2)).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }

  CellNodes nodes;
  Mat3 axes;
};

// Strains and stresses of layers per unit of a motion, from states to both sides of it: exact for
// strains, which are quadratic.
States slopes(States forward, const States& back, double size) {
  for (std::size_t i = 0; i < forward.size(); ++i) {
    forward[i].strain = (forward[i].strain - back[i].strain) / (2.0 * size);
    forward[i].stress = (forward[i].stress - back[i].stress) / (2.0 * size);
  }
  return forward;
}

// A wall by its answers to gradients of displacements, so whatever its layers are.
class ProbedWall {
 public:
  /// @param q  the same again when this is made
  ProbedWall(const model::LayerSource& source, int cell, const model::Cell& shape, Coordinates& q)
      : source_(source), cell_(cell), corners_(shape, q), q_(q) {
    for (int n = 0; n < 2; ++n) {
      for (int a = 0; a < 3; ++a) {
        answers_[static_cast<std::size_t>(n)][static_cast<std::size_t>(a)] =
            probe([&](const Vec3& x, const Vec3& d) {
              const Vec3 normal = corners_.axes.col(n);
              const Vec3 along = corners_.axes.col(a);
              return Mat<3, 2>(
                  (Mat<3, 2>() << normal.dot(x) * along, normal.dot(d) * along).finished());
            });
      }
    }
    compute_points();
  }

  // Stiffness and geometric matrices for the waves of a normal in the plane, in u and v ζ / t.
  Mat6 stiffness(double angle) const {
    const std::array<States, 3> wave = combine(angle);
    Mat6 sum = Mat6::Zero();
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      add(i, density(wave, i), sum);
    }
    return sum;
  }
  Mat6 geometric(double angle, const States& stress) const {
    const std::array<States, 3> wave = combine(angle);
    Mat6 sum = Mat6::Zero();
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const Vec6& normal = wave[2][i].strain;  // a wave along the third axis shears by its normal
      const Vec6& S = stress[i].stress;
      const double across = normal[4] * normal[4] * S[0] + normal[3] * normal[3] * S[1] +
                            2.0 * normal[3] * normal[4] * S[5];
      add(i, across * Mat3::Identity(), sum);
    }
    return sum;
  }
  // The smallest stiffness of any layer against waves of any normal [N/m^2]
  double softest() const {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < directions; ++k) {
      const std::array<States, 3> wave = combine(k * step);
      for (std::size_t i = 0; i < weights_.size(); ++i) {
        const Eigen::SelfAdjointEigenSolver<Mat3> found(density(wave, i), Eigen::EigenvaluesOnly);
        least = std::min(least, found.eigenvalues()[0]);
      }
    }
    return least;
  }

  static constexpr int directions = 36;
  static constexpr double step = std::numbers::pi / directions;

 private:
  // motion(x, d) of a node: changes of both
  template <class Motion>
  States probe(const Motion& motion) const {
    constexpr double size = 1e-4;
    const auto at = [&](double factor) {
      std::vector<model::NodeSlots> before;
      for (const int node : corners_.nodes) {
        auto slots = model::NodeTable::slots(q_, node);
        before.emplace_back(slots);
        slots.leftCols<2>() += factor * motion(Vec3(slots.col(0)), Vec3(slots.col(1)));
      }
      States states = source_.states(cell_, q_);
      for (std::size_t a = 0; a < before.size(); ++a) {
        model::NodeTable::slots(q_, corners_.nodes[a]) = before[a];
      }
      return states;
    };
    return slopes(at(size), at(-size), size);
  }

  // Bent to a unit curvature a layer is strained by its height; Simpson's rule for each.
  void compute_points() {
    const Vec3 first = corners_.axes.col(0);
    const States bent = probe([&](const Vec3& x, const Vec3&) {
      return Mat<3, 2>((Mat<3, 2>() << Vec3::Zero(), first.dot(x) * first).finished());
    });
    for (const model::LayerState& state : bent) {
      heights_.push_back(state.strain[0] + state.strain[1]);
    }
    const double thickness = heights_.back() - heights_.front();
    for (std::size_t i = 0; i < heights_.size(); i += heights) {
      const double share = (heights_[i + 2] - heights_[i]) / thickness;
      weights_.insert(weights_.end(), {share / 6.0, share * 4.0 / 6.0, share / 6.0});
    }
    for (double& height : heights_) height /= thickness;
  }

  std::array<States, 3> combine(double angle) const {
    std::array<States, 3> wave = answers_[0];
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t i = 0; i < wave[a].size(); ++i) {
        const auto mix = [&](const Vec6& first, const Vec6& second) -> Vec6 {
          return std::cos(angle) * first + std::sin(angle) * second;
        };
        wave[a][i] = {mix(answers_[0][a][i].strain, answers_[1][a][i].strain),
                      mix(answers_[0][a][i].stress, answers_[1][a][i].stress)};
      }
    }
    return wave;
  }

  static Mat3 density(const std::array<States, 3>& wave, std::size_t i) {
    Mat3 A;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        A(static_cast<int>(a), static_cast<int>(b)) = wave[a][i].strain.dot(wave[b][i].stress);
      }
    }
    return 0.5 * (A + A.transpose());
  }

  void add(std::size_t i, const Mat3& part, Mat6& sum) const {
    const double shares[] = {1.0, heights_[i]};
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        sum.block<3, 3>(3 * r, 3 * c) += weights_[i] * shares[r] * shares[c] * part;
      }
    }
  }

  const model::LayerSource& source_;
  int cell_;
  Corners corners_;
  Coordinates& q_;
  // of gradients a ⊗ n, by n in the plane and a
  std::array<std::array<States, 3>, 2> answers_;
  std::vector<double> heights_;  // over the thickness
  std::vector<double> weights_;
};

// The largest pressure in the plane of any layer, in units of the stress [N/m^2].
double largest_pressure(const States& states, double sign) {
  double largest = 0.0;
  for (const model::LayerState& state : states) {
    const Vec6 S = sign * state.stress;
    const double radius = std::hypot(0.5 * (S[0] - S[1]), S[5]);
    largest = std::max(largest, radius - 0.5 * (S[0] + S[1]));
  }
  return largest;
}

// The factor nearest to zero, of one sign, at which stiffness + factor * geometric is singular for
// some normal; 0 if it is not definite to begin with.
double unstable_factor(const ProbedWall& wall, const States& base, const States& change,
                       double sign) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < ProbedWall::directions; ++k) {
    const double angle = k * ProbedWall::step;
    const Mat6 stiffness = wall.stiffness(angle) + wall.geometric(angle, base);
    const Mat6 geometric = -sign * wall.geometric(angle, change);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Mat6> found(geometric, stiffness,
                                                               Eigen::EigenvaluesOnly);
    if (found.info() != Eigen::Success) return 0.0;
    const double largest = found.eigenvalues()[5];
    if (largest > 0.0) nearest = std::min(nearest, 1.0 / largest);
  }
  return nearest;
}

// Limits of the cells that this rank looks at: every size-th.
class LimitSearch {
 public:
  LimitSearch(const assembly::System& system, const Coordinates& q, const Coordinates& motion)
      : comm_(system.comm()),
        structures_(system.model().structures()),
        q_(q),
        forward_(q),
        back_(q) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      forward_[i] += motion[i];
      back_[i] -= motion[i];
    }
    for (const model::Structure& structure : structures_) {
      if (structure.layers != nullptr) search(structure);
    }
  }

  // The nearest of all ranks; of several with the same value the first cell's.
  WallLimit nearest(std::size_t sign) const {
    const Found& mine = found_[sign];
    const double factor = -comm_.max(-mine.factor);
    WallLimit limit;
    if (std::isinf(factor)) return limit;
    limit.factor = sign == 0 ? factor : -factor;
    limit.cell = -comm_.max(mine.factor == factor ? -mine.place : std::numeric_limits<int>::min());
    for (const model::Structure& structure : structures_) {
      limit.structure = structure.name;
      if (structure.layers == nullptr) continue;
      if (limit.cell < static_cast<int>(structure.cells.size())) break;
      limit.cell -= static_cast<int>(structure.cells.size());
    }
    return limit;
  }

 private:
  struct Found {
    double factor = std::numeric_limits<double>::infinity();
    int place = 0;  // among the cells of all structures
  };

  void search(const model::Structure& structure) {
    double softest = -1.0;  // of the layers; found at the first cell that is looked at
    for (std::size_t cell = 0; cell < structure.cells.size(); ++cell, ++place_) {
      if (place_ % comm_.size() != comm_.rank()) continue;
      const int number = static_cast<int>(cell);
      const model::LayerSource& source = *structure.layers;
      const States base = source.states(number, q_);
      const States change =
          slopes(source.states(number, forward_), source.states(number, back_), 1.0);
      const auto probed = [&] { return ProbedWall(source, number, structure.cells[cell], q_); };
      if (softest < 0.0) softest = probed().softest();
      const double left = softest - largest_pressure(base, 1.0);
      for (std::size_t sign : {0, 1}) {
        const double direction = sign == 0 ? 1.0 : -1.0;
        // no layer gives way before this factor
        if (left >= found_[sign].factor * largest_pressure(change, direction)) continue;
        const double factor = unstable_factor(probed(), base, change, direction);
        if (factor < found_[sign].factor) found_[sign] = {factor, place_};
      }
    }
  }

  const parallel::Comm& comm_;
  const std::deque<model::Structure>& structures_;
  Coordinates q_;
  Coordinates forward_;
  Coordinates back_;
  std::array<Found, 2> found_;  // of positive and negative factors
  int place_ = 0;
};
}  // namespace

WallLimits find_wall_limits(const assembly::System& system, const model::Coordinates& q,
                            const model::Coordinates& motion) {
  const LimitSearch search(system, q, motion);
  return {search.nearest(0), search.nearest(1)};
}

}  // namespace culm::analysis
