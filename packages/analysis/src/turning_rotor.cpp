#include <culm/analysis/turning_rotor.hpp>
#include <culm/base/error.hpp>
#include <culm/model/steady_rotation.hpp>
#include <culm/solver/asymmetry.hpp>

#include "whole_matrix.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::analysis {
namespace {

using model::NodeTable;

// What a static analysis leaves unbalanced is less; a blade of its own makes more.
constexpr double equal = 1e-5;

const model::SteadyRotation& find_frame(const model::Model& model, const Where& where) {
  const model::SteadyRotation* found = nullptr;
  for (const auto& load : model.loads()) {
    const auto* frame = dynamic_cast<const model::SteadyRotation*>(load.get());
    if (frame == nullptr) continue;
    if (found != nullptr) throw InputError(where, "more than one load 'Rotating Frame' acts");
    found = frame;
  }
  if (found == nullptr) {
    throw InputError(where,
                     "a turning rotor needs a load 'Rotating Frame' that names its structures");
  }
  return *found;
}

// First unknowns of the vectors of a node; none if it has no unknowns of its own or is held.
std::vector<int> vectors_of(const model::Model& model, int node, const Where& where) {
  const model::Block block = model.unknowns().block(model.unknowns().node_block(node));
  if (block.owner != node || block.shape.active == 0) return {};
  if (!block.shape.full()) {
    throw InputError(where, fmt::format("a support holds some directions of node {}, which turns; "
                                        "only all of them or none may be held",
                                        model.node_name(node)));
  }
  std::vector<int> vectors;
  for (int i = 0; i < block.shape.width; i += 3) vectors.push_back(block.first + i);
  return vectors;
}

// A structure or a node set.
struct Blade {
  std::string name;
  std::vector<int> nodes;
};

Blade find_blade(const model::Model& model, const std::string& name,
                 const model::SteadyRotation& frame, const Where& where) {
  Blade blade{name, model.select_nodes(name)};
  if (blade.nodes.empty()) {
    throw InputError(where, fmt::format("no structure or node set '{}'", name));
  }
  if (!std::ranges::all_of(blade.nodes, [&](int node) { return frame.turns(node); })) {
    throw InputError(where, fmt::format("'{}' is not among the structures that the load 'Rotating "
                                        "Frame' turns",
                                        name));
  }
  return blade;
}

// How far the nodes of a blade are from those of the first one turned [m]; directors times length.
double mismatch(const model::Model& model, const model::Coordinates& q, const Blade& first,
                const Blade& blade, const Mat3& turn, const Vec3& point) {
  double worst = 0.0;
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    model::NodeSlots one = NodeTable::slots(q, first.nodes[i]);
    model::NodeSlots other = NodeTable::slots(q, blade.nodes[i]);
    one.col(0) -= point;
    other.col(0) -= point;
    model::NodeSlots apart = turn * one - other;
    apart.rightCols<3>() *= model.length();
    worst = std::max(worst, apart.colwise().norm().maxCoeff());
  }
  return worst;
}

// The vector from the axis to the middle of a blade.
Vec3 reach(const Blade& blade, const model::Coordinates& q, const model::SteadyRotation& frame) {
  Vec3 sum = Vec3::Zero();
  for (int node : blade.nodes) sum += NodeTable::slots(q, node).col(0) - frame.point();
  sum /= static_cast<double>(blade.nodes.size());
  return sum - frame.axis() * frame.axis().dot(sum);
}

void add_blades(const model::Model& model, const model::State& state,
                const model::SteadyRotation& frame, const RotorSettings& settings,
                RotorUnknowns& rotor) {
  const std::size_t count = settings.blades.size();
  if (count == 0) return;
  if (count < 3) {
    throw InputError(settings.where,
                     fmt::format("{} blades: a rotor of fewer than three is not the "
                                 "same in all directions, and its equations stay "
                                 "periodic",
                                 count));
  }
  const double part = 2.0 * std::numbers::pi / static_cast<double>(count);
  const Blade first = find_blade(model, settings.blades[0], frame, settings.where);
  const Vec3 r0 = reach(first, state.next, frame);
  std::vector<bool> taken(count, false);
  for (const std::string& name : settings.blades) {
    const Blade blade = find_blade(model, name, frame, settings.where);
    if (blade.nodes.size() != first.nodes.size()) {
      throw InputError(settings.where,
                       fmt::format("'{}' has {} nodes and '{}' {}: blades need equal meshes", name,
                                   blade.nodes.size(), first.name, first.nodes.size()));
    }
    const Vec3 r = reach(blade, state.next, frame);
    const double angle = std::atan2(frame.axis().dot(r0.cross(r)), r0.dot(r));
    const auto place =
        (std::lround(angle / part) + static_cast<long>(count)) % static_cast<long>(count);
    const double azimuth = part * static_cast<double>(place);
    const Mat3 turn = Eigen::AngleAxisd(azimuth, frame.axis()).matrix();
    const double apart = mismatch(model, state.next, first, blade, turn, frame.point());
    if (taken[static_cast<std::size_t>(place)] || apart > equal * model.length()) {
      throw InputError(
          settings.where,
          fmt::format("'{}' is not '{}' turned by a multiple of {:g} deg about the axis: nodes are "
                      "up to {:.3g} m apart.\nLeave out what acts differently on them, such as "
                      "gravity ('Inactive'), and use equal meshes",
                      name, first.name, 360.0 / static_cast<double>(count), apart));
    }
    taken[static_cast<std::size_t>(place)] = true;
    rotor.azimuth.push_back(azimuth);
    std::vector<int>& vectors = rotor.blades.emplace_back();
    for (int node : blade.nodes) {
      const std::vector<int> more = vectors_of(model, node, settings.where);
      vectors.insert(vectors.end(), more.begin(), more.end());
    }
    if (vectors.size() != rotor.blades.front().size()) {
      throw InputError(settings.where,
                       fmt::format("'{}' and '{}' are not held or connected at the same nodes",
                                   name, first.name));
    }
  }
}

RotorUnknowns find_rotor(const model::Model& model, const model::State& state,
                         const RotorSettings& settings) {
  const model::SteadyRotation& frame = find_frame(model, settings.where);
  RotorUnknowns rotor;
  rotor.axis = frame.axis();
  add_blades(model, state, frame, settings, rotor);
  std::vector<bool> is_blade(static_cast<std::size_t>(model.nodes().size()), false);
  for (const std::string& name : settings.blades) {
    for (int node : model.select_nodes(name)) {
      is_blade[static_cast<std::size_t>(node)] = true;
    }
  }
  for (int node = 0; node < model.nodes().size(); ++node) {
    if (is_blade[static_cast<std::size_t>(node)] || !frame.turns(node)) continue;
    const std::vector<int> vectors = vectors_of(model, node, settings.where);
    if (vectors.empty()) continue;
    const auto slots = NodeTable::slots(state.next, node);
    const Vec3 arm = frame.axis().cross(Vec3(slots.col(0)) - frame.point());
    if (arm.norm() > equal * model.length() || !model.nodes().turns(node)) {
      throw InputError(
          settings.where,
          fmt::format("node {} turns, belongs to no blade and is {}: connect it rigidly "
                      "to one on the axis, or make it part of one of the 'Blades'",
                      model.node_name(node),
                      model.nodes().turns(node)
                          ? fmt::format("{:.3g} m away from the axis", arm.norm())
                          : "part of a shell"));
    }
    rotor.hub.push_back(vectors[0]);
    if (vectors.size() == 4) {
      rotor.triads.push_back({vectors[1], slots.rightCols<3>()});
    } else {
      rotor.hub.push_back(vectors[1]);
    }
  }
  return rotor;
}

}  // namespace

void warn_of_turning_part(const model::Model& model, const Log& log) {
  for (const auto& load : model.loads()) {
    const auto* frame = dynamic_cast<const model::SteadyRotation*>(load.get());
    if (frame == nullptr) continue;
    int turning = 0;
    for (int node = 0; node < model.nodes().size(); ++node) turning += frame->turns(node);
    if (turning == model.nodes().size()) continue;
    log.warning(
        "the load 'Rotating Frame' turns some structures only: that has a meaning in static "
        "analyses "
        "and in modes with a 'Rotor', not here");
  }
}

TurningRotor::TurningRotor(const assembly::System& system, const model::State& state,
                           const RotorSettings& settings)
    : system_(system),
      where_(settings.where),
      speed_(find_frame(system.model(), settings.where).speed(state, Stencil::statics())),
      rotor_(find_rotor(system.model(), state, settings)),
      map_(system.model().unknowns().num_unknowns(), rotor_) {}

// Between all nodes of the rotor. With themselves those of the hub may be held by springs that do
// not turn, so there only the mass counts.
void TurningRotor::refuse_asymmetry(const SparseMatrix& matrix, bool of_hub,
                                    const char* what) const {
  constexpr int stands = -1;
  std::vector<int> block_of(static_cast<std::size_t>(matrix.rows()), stands);
  std::vector<bool> is_blade(static_cast<std::size_t>(matrix.rows()), false);
  std::vector<int> vectors = rotor_.hub;
  for (const auto& triad : rotor_.triads) {
    for (int i = 0; i < 3; ++i) vectors.push_back(triad.first + 3 * i);
  }
  for (const auto& blade : rotor_.blades) {
    vectors.insert(vectors.end(), blade.begin(), blade.end());
    for (int at : blade) is_blade[static_cast<std::size_t>(at)] = true;
  }
  for (int at : vectors) {
    const int block = system_.model().unknowns().block_of(at);
    for (int i = 0; i < 3; ++i) {
      block_of[static_cast<std::size_t>(at + i)] = block;
      is_blade[static_cast<std::size_t>(at + i)] = is_blade[static_cast<std::size_t>(at)];
    }
  }
  const auto counts = [&](Eigen::Index row, Eigen::Index column) {
    const auto r = static_cast<std::size_t>(row);
    const auto c = static_cast<std::size_t>(column);
    if (block_of[r] == stands || block_of[c] == stands) return false;
    return of_hub || is_blade[r] || is_blade[c] || block_of[r] != block_of[c];
  };
  SparseMatrix here = matrix;
  here.prune([&](Eigen::Index row, Eigen::Index column, double) { return counts(row, column); });
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(here.rows());
  const auto each = [](const SparseMatrix& entries, const auto& action) {
    for (int c = 0; c < entries.outerSize(); ++c) {
      for (SparseMatrix::InnerIterator entry(entries, c); entry; ++entry) action(entry);
    }
  };
  each(here, [&](const auto& entry) {
    largest[entry.row()] = std::max(largest[entry.row()], std::abs(entry.value()));
  });
  // vectors turn into each other, so their components have the scale of the largest one
  for (int at : vectors) {
    largest.segment<3>(at).setConstant(largest.segment<3>(at).maxCoeff());
  }
  const SparseMatrix turned = map_.symmetry().transpose() * here * map_.symmetry();
  double worst = 0.0;
  each(SparseMatrix(turned - here), [&](const auto& entry) {
    if (!counts(entry.row(), entry.col())) return;
    const double size = std::sqrt(largest[entry.row()] * largest[entry.col()]);
    if (size > 0.0) worst = std::max(worst, std::abs(entry.value()) / size);
  });
  if (worst <= equal) return;
  throw InputError(
      where_,
      fmt::format("the rotor is not the same after {}: its {} changes by {:.2g} of it, so its "
                  "equations stay periodic.\nBlades must be equal and parts of the hub symmetric "
                  "about the axis; leave out what acts differently on the blades, such as gravity "
                  "('Inactive')",
                  rotor_.blades.empty() ? "a third of a turn"
                                        : fmt::format("1/{} of a turn", rotor_.blades.size()),
                  what, worst));
}

Linearisation TurningRotor::transform(const Linearisation& linear, bool damping) {
  const parallel::Comm& comm = system_.comm();
  const SparseMatrix K = whole(*linear.stiffness, comm);
  const SparseMatrix M = whole(*linear.mass, comm);
  SparseMatrix C(K.rows(), K.cols());
  if (linear.damping) {
    C = whole(*linear.damping, comm);
    // dampers are symmetric, gyroscopic forces skew
    if (!damping) C = SparseMatrix(0.5 * (C - SparseMatrix(C.transpose())));
  }
  refuse_asymmetry(M, true, "mass");
  // beside constraints that are equations stiffness is not unique, and so not symmetric
  if (system_.model().unknowns().form() == model::Form::null_space) {
    refuse_asymmetry(K, false, "stiffness");
  }

  const SparseMatrix& L = map_.L();
  const SparseMatrix LT = L.transpose();
  const SparseMatrix KL = K * L;
  const SparseMatrix CL1 = C * map_.first();
  const SparseMatrix ML2 = M * map_.second();
  const SparseMatrix CL = C * L;
  const SparseMatrix ML1 = M * map_.first();
  const SparseMatrix stiffness = LT * SparseMatrix(KL + speed_ * CL1 + speed_ * speed_ * ML2);
  const SparseMatrix rates = LT * SparseMatrix(CL + 2.0 * speed_ * ML1);
  mass_ = LT * SparseMatrix(M * L);
  // all with the entries of any of them, because combinations need one graph
  const SparseMatrix none = 0.0 * (SparseMatrix(stiffness + rates) + mass_);
  const auto spread = [&](const SparseMatrix& matrix) {
    return std::make_shared<const assembly::Matrix>(linear.stiffness->rows(), matrix + none);
  };
  Linearisation result = linear;
  result.stiffness = spread(stiffness);
  result.mass = spread(mass_);
  result.damping = rates.coeffs().size() == 0 || rates.coeffs().abs().maxCoeff() == 0.0
                       ? nullptr
                       : spread(rates);
  result.asymmetry = solver::asymmetry(result.stiffness, comm);
  return result;
}

// L(psi) = L(0) exp(psi S): in coordinates z of multi-blade form rates are d/dt + Omega S, so a
// function f of the rate is sum_m f(d/dt + i m Omega) Pi_m with the projectors of S on its
// eigenvalues i m, products of S - i n over all other n.
std::vector<BranchTerm> TurningRotor::terms_of(const SparseMatrix& branches, double time,
                                               bool of_velocity) const {
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;
  refuse_asymmetry(branches, false, "relaxation");
  const std::complex<double> i(0.0, 1.0);
  const SparseMatrix LT = map_.L().transpose();
  const Matrix S = SparseMatrix(LT * map_.first()).cast<std::complex<double>>();
  const Matrix G =
      SparseMatrix(LT * SparseMatrix(branches * map_.L())).cast<std::complex<double>>();
  Matrix one(S.rows(), S.cols());
  one.setIdentity();
  const int most = std::max<int>(2, static_cast<int>(rotor_.azimuth.size()) / 2);
  std::vector<BranchTerm> terms;
  for (int m = -most; m <= most; ++m) {
    Matrix part = G;
    for (int n = -most; n <= most; ++n) {
      if (n == m) continue;
      const Matrix factor = (S - Matrix(i * double(n) * one)) * (1.0 / (i * double(m - n)));
      part = Matrix(part * factor).pruned();
    }
    if (part.nonZeros() > 0) terms.push_back({part, time, i * double(m) * speed_, of_velocity});
  }
  return terms;
}

WhirlShares TurningRotor::whirl(const Eigen::VectorXcd& z) const {
  return whirl_shares(rotor_, mass_, z);
}

}  // namespace culm::analysis
