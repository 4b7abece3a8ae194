#include <culm/analysis/path_condition.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace culm::analysis {

using assembly::Vector;

namespace {

// Where nodes move as they turn, as in bending, displacements decide; rotations do where nodes turn
// in place, or about something near.
constexpr double arm_over_length = 0.1;
// Of the change of the watched displacement by the arc length: what is less is rounding.
constexpr double least_watched = 1e-9;

// A rotation changes all three directors of a triad, |dd|^2 = 2 |theta|^2, and the one of a shell
// node.
Eigen::VectorXd director_weights(const model::Model& model) {
  const double arm = PathCondition::turning_arm(model);
  Eigen::VectorXd weights(model.nodes().size());
  for (int node = 0; node < model.nodes().size(); ++node) {
    weights[node] = model.nodes().kind(node) == NodeKind::node12 ? std::sqrt(0.5) * arm : arm;
  }
  return weights;
}

}  // namespace

double PathCondition::turning_arm(const model::Model& model) {
  return arm_over_length * model.length();
}

PathCondition::PathCondition(assembly::System& system, PathControl control,
                             const std::optional<WatchedMotion>& watched, double level_difference)
    : system_(system),
      control_(control),
      watched_(watched),
      level_difference_(level_difference),
      weights_(director_weights(system.model())),
      present_(control) {
  const model::UnknownTable& unknowns = system.model().unknowns();
  const std::vector<int>& owners = system.layout().owners();
  const int count = system.model().nodes().size();
  for (int node = 0; node < count; ++node) {
    const auto block = static_cast<std::size_t>(unknowns.node_block(node));
    if (owners[block] == system.comm().rank()) nodes_.push_back(node);
  }
  for (Motion* motion : {&direction_, &flexibility_, &response_, &way_}) {
    motion->setZero(12, count);
  }
}

void PathCondition::begin(double size) {
  present_ = control_;
  size_ = size;
  first_increment_.reset();
  has_begun_ = false;
  missing_iterations_ = 0;
  tangent_.reset();
}

void PathCondition::begin_back(double size) {
  begin(-size);
  present_ = PathControl::normal_plane;
}

void PathCondition::begin_first(double level_increment) {
  begin(0.0);
  first_increment_ = level_increment;
}

void PathCondition::begin_to_displacement(double distance) {
  present_ = PathControl::displacement;
  size_ = distance;
}

double PathCondition::begin_branch(const model::State& state, const Vector& motion, double size) {
  begin(std::abs(size));
  present_ = PathControl::normal_plane;
  has_begun_ = true;
  missing_iterations_ = 3;
  read_slots(system_.linear_motion(state, motion, 1.0), direction_);
  // a direction has no sense: the watched displacement grows, or else the largest of all
  Eigen::Index row = 0, node = 0;
  const double largest = direction_.cwiseAbs().maxCoeff(&row, &node);
  const double watched = watched_part(direction_);
  const bool is_watched = std::abs(watched) > 1e-3 * largest;
  const double sense = std::copysign(1.0, is_watched ? watched : direction_(row, node));
  const double norm = sense * std::sqrt(dot(direction_, direction_));
  direction_ *= std::copysign(1.0, size) / norm;
  read_way(state);
  size_ += dot(direction_, way_);
  return size / norm;
}

// Each value from the rank that has it: sums over nodes are then the same for any number of ranks.
void PathCondition::complete(Motion& motion) const {
  if (system_.comm().size() == 1) return;
  system_.comm().sum(std::span(motion.data(), static_cast<std::size_t>(motion.size())));
}

void PathCondition::read_slots(const model::Coordinates& q, Motion& motion) const {
  motion.setZero();
  for (const int node : nodes_) {
    motion.col(node) = model::NodeTable::slots(q, node).reshaped();
    motion.col(node).tail<9>() *= weights_[node];
  }
  complete(motion);
}

void PathCondition::read_way(const model::State& state) {
  way_.setZero();
  for (const int node : nodes_) {
    way_.col(node) =
        (model::NodeTable::slots(state.next, node) - model::NodeTable::slots(state.prev, node))
            .reshaped();
    way_.col(node).tail<9>() *= weights_[node];
  }
  complete(way_);
}

double PathCondition::dot(const Motion& a, const Motion& b) {
  return a.cwiseProduct(b).sum() / static_cast<double>(a.cols());
}

double PathCondition::watched_part(const Motion& motion) const {
  return watched_ ? watched_->direction.dot(motion.col(watched_->node).head<3>()) : 0.0;
}

double PathCondition::watched_by_level(const model::State& state, const Vector& flexibility) const {
  Motion motion = way_;
  read_slots(system_.linear_motion(state, flexibility, 1.0), motion);
  return watched_part(motion);
}

double PathCondition::watched_displacement(const model::Coordinates& q) const {
  if (!watched_) return 0.0;
  Vec3 displacement = Vec3::Zero();
  if (std::find(nodes_.begin(), nodes_.end(), watched_->node) != nodes_.end()) {
    const model::Coordinates& reference = system_.model().nodes().reference();
    displacement = model::NodeTable::slots(q, watched_->node).col(0) -
                   model::NodeTable::slots(reference, watched_->node).col(0);
  }
  system_.comm().sum(std::span(displacement.data(), 3));
  return watched_->direction.dot(displacement);
}

// From a = flexibility_: of the two senses of the path the one in which the last step went.
void PathCondition::set_tangent() {
  const double size = std::sqrt(dot(flexibility_, flexibility_));
  double sense = level_difference_;
  if (!previous_.size() == 0) {
    sense = dot(flexibility_, previous_);
  } else if (present_ == PathControl::displacement) {
    sense = size_ * watched_part(flexibility_);
  }
  const double rate = std::copysign(1.0, sense) / size;
  const double watched = rate * watched_part(flexibility_);
  tangent_ = PathTangent{rate, std::abs(watched) < least_watched ? 0.0 : watched};
  direction_ = rate * flexibility_;
}

void PathCondition::compute_tangent(const model::State& state, const Vector& flexibility) {
  read_slots(system_.linear_motion(state, flexibility, 1.0), flexibility_);
  set_tangent();
}

double PathCondition::predict() {
  set_tangent();
  if (first_increment_) size_ = std::abs(*first_increment_ / tangent_->level);
  first_increment_.reset();
  if (present_ == PathControl::displacement) return correct();
  return size_ * tangent_->level;
}

double PathCondition::correct() const {
  const auto &a = flexibility_, &b = response_, &d = way_;
  switch (present_) {
    case PathControl::displacement:
      return (size_ - watched_part(d) - watched_part(b)) / watched_part(a);
    case PathControl::normal_plane:
      return (size_ - dot(direction_, d) - dot(direction_, b)) / dot(direction_, a);
    case PathControl::sphere: {
      // |d + b + x a|^2 = l^2; of the two roots the one that goes on in the direction of d
      const double aa = dot(a, a);
      const double half = dot(d, a) + dot(b, a);
      const double rest = dot(d, d) + 2.0 * dot(d, b) + dot(b, b) - size_ * size_;
      const double root = half * half - aa * rest;
      if (root >= 0.0) return (-half + std::copysign(std::sqrt(root), dot(a, d))) / aa;
      break;  // no real root: linearised
    }
    case PathControl::linearised_sphere:
      break;
  }
  return -(dot(d, b) + 0.5 * (dot(d, d) - size_ * size_)) / dot(d, a);
}

double PathCondition::level_increment(const model::State& state, const Vector& response,
                                      const Vector& flexibility) {
  read_slots(system_.linear_motion(state, response, 1.0), response_);
  read_slots(system_.linear_motion(state, flexibility, 1.0), flexibility_);
  read_way(state);
  --missing_iterations_;
  if (has_begun_) return correct();
  has_begun_ = true;
  probe_();
  return predict();
}

double PathCondition::violation(const model::State& state) {
  // before the first iteration nothing is known but that there is a way to go
  if (first_increment_) return 1.0;
  // at a crossing hardly a force resists the move, though the level is that of the other path
  // still, and that is what the next step goes by
  if (missing_iterations_ > 0) return 1.0;
  read_way(state);
  double gone = 0.0;
  if (present_ == PathControl::displacement) {
    gone = watched_part(way_);
  } else if (present_ == PathControl::normal_plane) {
    gone = has_begun_ ? dot(direction_, way_) : 0.0;
  } else {
    gone = std::sqrt(dot(way_, way_));
  }
  return std::abs(gone - size_) / system_.model().length();
}

const PathCondition::Motion& PathCondition::way(const model::State& state) {
  read_way(state);
  return way_;
}

double PathCondition::length(const Motion& way) { return std::sqrt(dot(way, way)); }

double PathCondition::length(const model::State& state) { return length(way(state)); }

double PathCondition::straightness(const model::State& state) {
  read_way(state);
  return dot(direction_, way_) / std::sqrt(dot(way_, way_));
}

void PathCondition::accept(const model::State& state) {
  read_way(state);
  previous_ = way_;
}

void PathCondition::save(Snapshot& snapshot) const {
  snapshot.set("path/increment", std::span<const double>(
                                     previous_.data(), static_cast<std::size_t>(previous_.size())));
}

void PathCondition::restore(const Snapshot& snapshot) {
  const std::span<const double> increment = snapshot.numbers("path/increment");
  previous_ = Eigen::Map<const Motion>(increment.data(), 12,
                                       static_cast<Eigen::Index>(increment.size() / 12));
}

}  // namespace culm::analysis
