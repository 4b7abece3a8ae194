#include "weak_direction.hpp"

#include <culm/base/text.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace culm::analysis {
namespace {

using assembly::Vector;

constexpr double notable = 0.05;          // share in a direction of unit maximum norm
constexpr std::size_t shown = 6;          // entries of a direction in a message
constexpr double least_resistance = 4.0;  // of a motion that is not free; those of free ones are
                                          // below 0.3
constexpr double free_resistance = 1.0;   // below, rounding is larger than what resists

// A motion that at most so much of all nodes carry is local, and a mesh does not resolve it with
// fewer nodes than these, on a line and on a surface: a bump exp(-r^2 / 2 s^2) over elements of
// length s / 2 has sqrt(2 pi) 2 and 2 pi 4.
constexpr double local_share = 0.1;
constexpr double least_on_line = 5.0;
constexpr double least_on_surface = 25.0;

// A vector of directions, with round-off as zero.
std::string vector_name(const Vec3& v) {
  const double size = std::max(v.lpNorm<Eigen::Infinity>(), 1e-300);
  const auto shown_as = [size](double x) { return std::abs(x) < 1e-3 * size ? 0.0 : x; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", shown_as(v[0]), shown_as(v[1]), shown_as(v[2]));
}

// The motion v0 + turn x (x - x0) in words.
std::string rigid_motion_name(const Vec3& x0, const Vec3& v0, const Vec3& turn) {
  if (turn.norm() < notable) return "moves along " + vector_name(v0.normalized());
  Vec3 n = turn.normalized();
  const Vec3 centre = x0 + n.cross(v0) / turn.norm();
  int largest = 0;
  n.cwiseAbs().maxCoeff(&largest);
  if (n[largest] < 0.0) n = -n;  // an axis has no sense
  const bool slides = std::abs(n.dot(v0)) > notable;
  return fmt::format("turns about the axis {} through {}{}", vector_name(n), vector_name(centre),
                     slides ? " and moves along it" : "");
}

}  // namespace

bool WeakDirection::is_multiplier(const Vector& vector, std::size_t i) const {
  const auto unknown = vector.rows().global(i);
  return names_.place_of(static_cast<int>(unknown)).block.kind != model::BlockKind::node;
}

double WeakDirection::resistance(const Vector& direction) const {
  assembly::Matrix absolute = *system_.matrix();
  // where nothing at all resists, what rounding left of a direction elsewhere would resist alone
  constexpr double rounding = 1e-12;
  Vector motion = direction;
  const double least = rounding * motion.largest();
  for (double& value : motion.values()) value = std::abs(value) < least ? 0.0 : value;
  Vector image(motion.rows());
  absolute.multiply(motion, image);
  const double work = motion.dot(image);
  for (double& value : absolute.values()) value = std::abs(value);
  Vector size = motion;
  for (double& value : size.values()) value = std::abs(value);
  absolute.multiply(size, image);
  const double held = size.dot(image);
  return held > 0.0 ? std::abs(work) / (std::numeric_limits<double>::epsilon() * held) : 0.0;
}

bool WeakDirection::is_free(const Vector& motion) const {
  return resistance(motion) < free_resistance;
}

// In a sound model K u + H^T lambda = 0 and H u = 0 hold with H^T lambda = 0 as well, because K has
// no negative direction: redundant equations and a mechanism may come together, each for itself.
std::string WeakDirection::singular_cause(const Vector& direction) const {
  Vector multipliers = direction;
  Vector motion = direction;
  const auto lambda = multipliers.values();
  const auto u = motion.values();
  for (std::size_t i = 0; i < u.size(); ++i) {
    (is_multiplier(direction, i) ? u : lambda)[i] = 0.0;
  }
  Vector image(direction.rows());
  system_.matrix()->multiply(multipliers, image);
  const double share = multipliers.largest();
  const bool redundant =
      share >= notable && image.largest() <= 1e-9 * share * system_.matrix()->norm();
  const bool moves = motion.largest() >= notable;
  if (!redundant && !moves) {
    return "Likely cause: stiffnesses or lengths that differ too much in size for double "
           "precision.\nTry: check units.";
  }
  std::string text;
  if (redundant) text += redundant_constraints(multipliers);
  if (redundant && moves) text += '\n';
  if (moves) text += mechanism(motion);
  return text;
}

std::string WeakDirection::redundant_constraints(const Vector& multipliers) const {
  const model::Model& model = system_.model();
  const auto shares = names_.entries(multipliers, notable);
  std::map<int, std::vector<std::string>> equations;  // their numbers, by constraint
  std::vector<std::string> others;                    // what batches own
  for (const auto& [unknown, share] : shares) {
    const UnknownNames::Place place = names_.place_of(unknown);
    if (place.block.kind == model::BlockKind::own) {
      others.push_back(names_.name_of(unknown));
    } else {
      equations[place.block.owner].push_back(std::to_string(place.written + 1));
    }
  }
  std::string text = "Likely cause: redundant constraints. These equations depend on each other:\n";
  std::set<int> held;
  std::set<std::string> named;
  for (const auto& [number, rows] : equations) {
    // those of unit directors come after all others, and nobody can remove them
    if (static_cast<std::size_t>(number) >= model.constraints().size()) continue;
    const model::Constraint& c = model.equations()[static_cast<std::size_t>(number)];
    text += fmt::format("  {}, {} {}\n", quoted_name(c), rows.size() > 1 ? "equations" : "equation",
                        join(rows, ", "));
    named.insert(quoted_name(c));
    for (const int node : c.nodes) held.insert(model.nodes().master(node));
  }
  for (const std::string& other : others) text += fmt::format("  {}\n", other);
  std::set<std::string> as_well;
  for (const model::Constraint& c : model.constraints()) {
    const bool meets = std::any_of(c.nodes.begin(), c.nodes.end(), [&](int node) {
      return held.count(model.nodes().master(node)) > 0;
    });
    if (!meets || named.count(quoted_name(c)) > 0 || as_well.size() >= shown) continue;
    if (!as_well.insert(quoted_name(c)).second) continue;
    text += fmt::format("  {}, which acts on the same nodes\n", quoted_name(c));
  }
  return text + "Try: remove one of the constraints, or a direction that another one holds.";
}

WeakDirection::Motions WeakDirection::moved_nodes(const Vector& motion) const {
  const model::Model& model = system_.model();
  const auto entries = names_.entries(motion, 1e-3 * notable);
  std::map<int, model::NodeSlots> increments;  // by node; six motions or twelve coordinates
  for (const auto& [unknown, value] : entries) {
    const UnknownNames::Place place = names_.place_of(unknown);
    if (place.block.kind != model::BlockKind::node) continue;
    auto& slots = increments.try_emplace(place.block.owner, model::NodeSlots::Zero()).first->second;
    slots.data()[place.written] = value;
  }
  std::map<int, Vec6> moved;
  for (const auto& [node, slots] : increments) {
    moved[node] = model.unknowns().form() == model::Form::null_space
                      ? Vec6(Eigen::Map<const Vec6>(slots.data()))
                      : model.nodes().unknown_motion(node, slots, q_);
  }
  return moved;
}

std::string WeakDirection::largest_motions(const Motions& moved) const {
  std::vector<UnknownNames::Entry> shares;
  for (const auto& [node, motion] : moved) {
    for (int i = 0; i < 6; ++i) {
      if (std::abs(motion[i]) < notable) continue;
      const std::string name = system_.model().node_name(node);
      shares.push_back({fmt::format("{}, {}", name, direction_name(i)), motion[i]});
    }
  }
  // by what is shown, so that round-off does not choose the order
  std::stable_sort(
      shares.begin(), shares.end(), [](const UnknownNames::Entry& a, const UnknownNames::Entry& b) {
        return std::lround(1e3 * std::abs(a.value)) > std::lround(1e3 * std::abs(b.value));
      });
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, shares.size()); ++i) {
    text += fmt::format("  {:<40} {:+.3f}\n", shares[i].name, shares[i].value);
  }
  return text;
}

std::string WeakDirection::largest_motions(const Vector& motion) const {
  return largest_motions(moved_nodes(motion));
}

// By translations, unless there are none to speak of.
WeakDirection::Extent WeakDirection::extent(const Motions& moved) const {
  double translation = 0.0;
  double rotation = 0.0;
  for (const auto& [node, motion] : moved) {
    translation = std::max(translation, motion.head<3>().norm());
    rotation = std::max(rotation, motion.tail<3>().norm());
  }
  const bool by_rotation = translation < 1e-3 * system_.model().length() * rotation;
  Extent extent;
  double sum = 0.0, squares = 0.0, largest = 0.0;
  for (const auto& [node, motion] : moved) {
    const double m = (by_rotation ? motion.tail<3>() : motion.head<3>()).squaredNorm();
    sum += m;
    squares += m * m;
    if (m > largest) {
      largest = m;
      extent.peak = node;
    }
  }
  if (squares > 0.0) extent.nodes = sum * sum / squares;
  return extent;
}

std::string WeakDirection::local_cause(const Vector& motion) const {
  const model::Model& model = system_.model();
  const Extent found = extent(moved_nodes(motion));
  if (found.peak < 0 || found.nodes > local_share * model.nodes().size()) return {};
  const model::Structure* structure = model.structure_of(found.peak);
  const bool is_surface = structure != nullptr && !structure->cells.empty() &&
                          structure->cells.front().nodes.size() > 2;
  if (found.nodes >= (is_surface ? least_on_surface : least_on_line)) return {};
  return fmt::format(
      "a local loss of stiffness at '{}'. Only {:.0f} of {} nodes carry the\n"
      "motion that loses it: a load crumples the mesh there, which is too coarse to follow, or a\n"
      "small part gives way",
      model.node_name(found.peak), found.nodes, model.nodes().size());
}

std::string WeakDirection::rigid_motions(const Motions& moved) const {
  const model::Model& model = system_.model();
  std::string text;
  for (const model::Structure& structure : model.structures()) {
    const auto first = moved.find(model.nodes().master(structure.nodes.front()));
    if (first == moved.end()) continue;
    const Vec3 x0 = model::NodeTable::slots(q_, first->first).col(0);
    const Vec3 v0 = first->second.head<3>();
    const Vec3 turn = first->second.tail<3>();
    const bool is_rigid =
        std::all_of(structure.nodes.begin(), structure.nodes.end(), [&](int node) {
          if (model.nodes().kind(node) != NodeKind::node12) return false;  // it has no rotation
          const int master = model.nodes().master(node);
          const auto at = moved.find(master);
          const Vec6 motion = at == moved.end() ? Vec6(Vec6::Zero()) : at->second;
          const Vec3 arm = Vec3(model::NodeTable::slots(q_, master).col(0)) - x0;
          Vec6 rigid;
          rigid << v0 + turn.cross(arm), turn;
          return (motion - rigid).lpNorm<Eigen::Infinity>() < notable;
        });
    if (!is_rigid) continue;
    std::vector<std::string> holders;
    for (const model::Constraint& c : model.constraints()) {
      const bool holds = std::any_of(c.nodes.begin(), c.nodes.end(), [&](int node) {
        return model.structure_of(node) == &structure;
      });
      const std::string name = quoted_name(c);
      if (holds && std::find(holders.begin(), holders.end(), name) == holders.end()) {
        holders.push_back(name);
      }
    }
    text += fmt::format("'{}' {}; {}\n", structure.name, rigid_motion_name(x0, v0, turn),
                        holders.empty() ? "nothing holds it" : "held by " + join(holders, ", "));
  }
  return text;
}

std::string WeakDirection::mechanism(const Vector& motion) const {
  const std::map<int, Vec6> moved = moved_nodes(motion);
  if (resistance(motion) > least_resistance) {
    return "Likely cause: stiffnesses or masses that differ too much in size for double "
           "precision.\n"
           "Beside the stiffest, almost nothing resists this motion:\n" +
           largest_motions(moved) +
           "Try: check units; make what is stiff or heavy less so, or rigid.";
  }
  return "Likely cause: a mechanism. Nothing resists this motion:\n" + largest_motions(moved) +
         rigid_motions(moved) +
         "Try: add a support or a joint that holds it, or give the section stiffness. If "
         "something\n"
         "does: beside stiffnesses 1e12 times as large it is lost in rounding; check units. What "
         "hangs from\n"
         "a hinge is stiff once it carries its weight: 'Static' finds it where it starts as it "
         "hangs; else\n"
         "hold it by a support that is 'Inactive' in the analysis after this one.";
}

std::string WeakDirection::massless(const Vector& direction) const {
  Vector motion = direction;
  const auto u = motion.values();
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (is_multiplier(motion, i)) u[i] = 0.0;  // they have no nodes
  }
  const std::string motions = largest_motions(moved_nodes(motion));
  return (motions.empty()
              ? "The mass matrix is singular: nothing has mass.\n"
              : "The mass matrix is singular: this motion has no inertia.\n" + motions) +
         "Try: give every structure a density or mass, and rotary inertia to its nodes.";
}

}  // namespace culm::analysis
