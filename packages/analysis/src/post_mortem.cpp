#include <culm/analysis/post_mortem.hpp>
#include <culm/base/error.hpp>
#include <culm/base/text.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace culm::analysis {
namespace {

using assembly::values_of;
using assembly::Vector;

constexpr std::size_t kept_attempts = 8;
constexpr double singular_ratio = 2e-15;  // |A v| / |A| of a direction that nothing resists
constexpr double notable = 0.05;          // share in a direction of unit maximum norm
constexpr std::size_t shown = 6;          // entries of a direction in a message
constexpr double least_resistance = 4.0;  // of a motion that is not free; those of free ones are
                                          // below 0.3

constexpr const char* beyond_range =
    "Likely cause: a load, stiffness or length beyond the range of numbers.\n"
    "Try: check units and load functions.";

const char* direction_name(int i) {
  constexpr const char* names[] = {"x", "y", "z", "rotation x", "rotation y", "rotation z"};
  return names[i];
}

const char* coordinate_name(int i) {
  constexpr const char* names[] = {"x",    "y",    "z",    "d1 x", "d1 y", "d1 z",
                                   "d2 x", "d2 y", "d2 z", "d3 x", "d3 y", "d3 z"};
  return names[i];
}

// entries without any symmetry, the same for any number of ranks
void fill_irregular(Vector& v) {
  const auto map = v.getMap();
  const auto values = values_of(v);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto global = static_cast<double>(map->getGlobalElement(static_cast<int>(i)));
    values[i] = std::fmod(0.6180339887498949 * (global + 1.0), 1.0) - 0.4;
  }
}

// The entries of at least `least` of all ranks by unknown, on rank 0.
std::map<int, double> gather_entries(const Vector& v, double least, const parallel::Comm& comm) {
  const auto values = values_of(v);
  std::vector<long long> mine;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) < least) continue;
    mine.push_back(v.getMap()->getGlobalElement(static_cast<int>(i)));
    sizes.push_back(values[i]);
  }
  const auto unknowns = comm.gather(std::span<const long long>(mine));
  const auto all = comm.gather(std::span<const double>(sizes));
  std::map<int, double> entries;
  for (std::size_t i = 0; i < all.size(); ++i) entries[static_cast<int>(unknowns[i])] = all[i];
  return entries;
}

std::string quoted_name(const model::Constraint& c) {
  return fmt::format("{} '{}'", c.type, c.name);
}

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

PostMortem::PostMortem(Context& context, model::State& state, const Stencil& stencil,
                       double first_level)
    : context_(context), level_step_(first_level - state.time) {
  first_flexibility_ = load_flexibility(state, stencil, level_step_);
  refuse_singular(state);
}

PostMortem::PostMortem(Context& context, model::State& state, const Stencil& stencil)
    : context_(context) {
  context_.system.evaluate(state, stencil, Want::residual_and_tangent);
  is_factored_ = context_.linear.factor();
  refuse_singular(state);
}

PostMortem::PostMortem(Context& context, const Snapshot& snapshot)
    : context_(context),
      first_flexibility_(snapshot.number("post-mortem/first flexibility")),
      level_step_(snapshot.number("post-mortem/level step")) {}

void PostMortem::save(Snapshot& snapshot) const {
  snapshot.set("post-mortem/first flexibility", first_flexibility_);
  snapshot.set("post-mortem/level step", level_step_);
}

void PostMortem::record(const StepReport& report) {
  if (attempts_.size() == kept_attempts) attempts_.pop_front();
  attempts_.push_back(report);
  if (!report.accepted) worst_ = largest_entries(context_.system.residual(), 5);
}

PostMortem::Place PostMortem::place_of(int unknown) const {
  const auto& blocks = context_.system.model().unknowns().blocks();
  const auto after = std::upper_bound(blocks.begin(), blocks.end(), unknown,
                                      [](int u, const model::Block& b) { return u < b.first; });
  // blocks without unknowns share the first of their successor, so the last one before is right
  const model::Block& block = *std::prev(after);
  const int place = unknown - block.first;
  int written = 0;
  while (block.shape.position[static_cast<std::size_t>(written)] != place) ++written;
  return {block, written};
}

std::string PostMortem::name_of(int unknown) const {
  const model::Model& model = context_.system.model();
  const auto [block, written] = place_of(unknown);
  if (block.kind == model::BlockKind::multipliers) {
    const model::Constraint& c = model.equations()[static_cast<std::size_t>(block.owner)];
    return fmt::format("{}, equation {}", quoted_name(c), written + 1);
  }
  const bool null_space = model.unknowns().form() == model::Form::null_space;
  return fmt::format("{}, {}", model.node_name(block.owner),
                     null_space ? direction_name(written) : coordinate_name(written));
}

std::vector<PostMortem::Entry> PostMortem::largest_entries(const Vector& vector,
                                                           std::size_t count) const {
  const auto values = values_of(vector);
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t kept = std::min(count, order.size());
  const auto larger = [&](std::size_t a, std::size_t b) {
    return std::abs(values[a]) > std::abs(values[b]);
  };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                    larger);
  std::vector<long long> mine;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < kept; ++i) {
    mine.push_back(vector.getMap()->getGlobalElement(static_cast<int>(order[i])));
    sizes.push_back(values[order[i]]);
  }
  const auto& comm = context_.system.comm();
  const auto unknowns = comm.gather(std::span<const long long>(mine));
  const auto all = comm.gather(std::span<const double>(sizes));
  std::vector<std::pair<double, int>> sorted;
  for (std::size_t i = 0; i < all.size(); ++i) {
    sorted.emplace_back(all[i], static_cast<int>(unknowns[i]));
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < std::min(count, sorted.size()); ++i) {
    entries.push_back({name_of(sorted[i].second), sorted[i].first});
  }
  return entries;
}

double PostMortem::load_flexibility(model::State& state, const Stencil& stencil,
                                    double level_step) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  assembly::System& system = context_.system;
  const double level = state.time;
  state.time = level + level_step;
  system.begin_step(state, stencil);
  system.evaluate(state, stencil, Want::residual);
  Vector load(system.residual(), Teuchos::Copy);
  state.time = level;
  system.begin_step(state, stencil);
  system.evaluate(state, stencil, Want::residual_and_tangent);
  load.update(1.0 / level_step, system.residual(), -1.0 / level_step);
  is_factored_ = context_.linear.factor();
  if (!is_factored_) return infinite;
  Vector response(load.getMap());
  if (context_.linear.solve(load, response) > 1e-8) return infinite;
  return load.dot(response);
}

void PostMortem::refuse_singular(const model::State& state) {
  assembly::System& system = context_.system;
  if (system.matrix()->getGlobalNumRows() == 0) return;  // held or rigid altogether
  Vector probe(system.layout().row_map());
  Vector response(system.layout().row_map());
  fill_irregular(probe);
  const double size = system.matrix()->getFrobeniusNorm();
  if (!std::isfinite(size)) {
    throw NonFiniteError(
        fmt::format("The stiffness is not finite at {} {:.6g}, before the first step.\n{}",
                    time_word(), state.time, beyond_range));
  }
  const bool solves = is_factored_ && context_.linear.solve(probe, response) < 1e-8;
  if (solves && response.normInf() * size < 1e13 * probe.normInf()) return;
  Vector direction(system.layout().row_map());
  const double ratio = context_.linear.weakest_direction(direction);
  // without useful factors no step can be solved, whatever the ratio
  if (solves && ratio > singular_ratio) return;
  throw NumericalError(system.comm().broadcast(
      fmt::format("The equations are singular at {} {:.6g}, before the first step.\n{}",
                  time_word(), state.time, singular_cause(state, direction))));
}

double PostMortem::resistance(const Vector& motion) const {
  using assembly::CrsMatrix;
  CrsMatrix absolute(*context_.system.matrix(), Teuchos::Copy);
  Vector image(motion.getMap());
  absolute.apply(motion, image);
  const double work = motion.dot(image);
  const auto values = absolute.getLocalMatrixHost().values;
  for (std::size_t k = 0; k < values.extent(0); ++k) values(k) = std::abs(values(k));
  Vector size(motion.getMap());
  size.abs(motion);
  absolute.apply(size, image);
  return std::abs(work) / (std::numeric_limits<double>::epsilon() * size.dot(image));
}

// In a sound model K u + H^T lambda = 0 and H u = 0 hold with H^T lambda = 0 as well, because K has
// no negative direction: redundant equations and a mechanism may come together, each for itself.
std::string PostMortem::singular_cause(const model::State& state, const Vector& direction) const {
  const assembly::System& system = context_.system;
  Vector multipliers(direction, Teuchos::Copy);
  Vector motion(direction, Teuchos::Copy);
  const auto lambda = values_of(multipliers);
  const auto u = values_of(motion);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto unknown = direction.getMap()->getGlobalElement(static_cast<int>(i));
    const Place place = place_of(static_cast<int>(unknown));
    (place.block.kind == model::BlockKind::multipliers ? u : lambda)[i] = 0.0;
  }
  Vector image(direction.getMap());
  system.matrix()->apply(multipliers, image);
  const double share = multipliers.normInf();
  const bool redundant =
      share >= notable && image.normInf() <= 1e-9 * share * system.matrix()->getFrobeniusNorm();
  const bool moves = motion.normInf() >= notable;
  if (!redundant && !moves) {
    return "Likely cause: stiffnesses or lengths that differ too much in size for double "
           "precision.\nTry: check units.";
  }
  std::string text;
  if (redundant) text += redundant_constraints(multipliers);
  if (redundant && moves) text += '\n';
  if (moves) text += mechanism(state, motion);
  return text;
}

std::string PostMortem::redundant_constraints(const Vector& multipliers) const {
  const model::Model& model = context_.system.model();
  const auto shares = gather_entries(multipliers, notable, context_.system.comm());
  std::map<int, std::vector<std::string>> equations;  // their numbers, by constraint
  for (const auto& [unknown, share] : shares) {
    const Place place = place_of(unknown);
    equations[place.block.owner].push_back(std::to_string(place.written + 1));
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

std::map<int, Vec6> PostMortem::moved_nodes(const model::State& state, const Vector& motion) const {
  const model::Model& model = context_.system.model();
  const auto entries = gather_entries(motion, 1e-3 * notable, context_.system.comm());
  std::map<int, model::NodeSlots> increments;  // by node; six motions or twelve coordinates
  for (const auto& [unknown, value] : entries) {
    const Place place = place_of(unknown);
    auto& slots = increments.try_emplace(place.block.owner, model::NodeSlots::Zero()).first->second;
    slots.data()[place.written] = value;
  }
  std::map<int, Vec6> moved;
  for (const auto& [node, slots] : increments) {
    moved[node] = model.unknowns().form() == model::Form::null_space
                      ? Vec6(Eigen::Map<const Vec6>(slots.data()))
                      : model.nodes().unknown_motion(node, slots, state.next);
  }
  return moved;
}

std::string PostMortem::largest_motions(const std::map<int, Vec6>& moved) const {
  std::vector<Entry> shares;
  for (const auto& [node, motion] : moved) {
    for (int i = 0; i < 6; ++i) {
      if (std::abs(motion[i]) < notable) continue;
      const std::string name = context_.system.model().node_name(node);
      shares.push_back({fmt::format("{}, {}", name, direction_name(i)), motion[i]});
    }
  }
  // by what is shown, so that round-off does not choose the order
  std::stable_sort(shares.begin(), shares.end(), [](const Entry& a, const Entry& b) {
    return std::lround(1e3 * std::abs(a.value)) > std::lround(1e3 * std::abs(b.value));
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, shares.size()); ++i) {
    text += fmt::format("  {:<40} {:+.3f}\n", shares[i].name, shares[i].value);
  }
  return text;
}

std::string PostMortem::rigid_motions(const model::State& state,
                                      const std::map<int, Vec6>& moved) const {
  const model::Model& model = context_.system.model();
  std::string text;
  for (const model::Structure& structure : model.structures()) {
    const auto first = moved.find(model.nodes().master(structure.nodes.front()));
    if (first == moved.end()) continue;
    const Vec3 x0 = model::NodeTable::slots(state.next, first->first).col(0);
    const Vec3 v0 = first->second.head<3>();
    const Vec3 turn = first->second.tail<3>();
    const bool is_rigid =
        std::all_of(structure.nodes.begin(), structure.nodes.end(), [&](int node) {
          if (model.nodes().kind(node) != NodeKind::node12) return false;  // it has no rotation
          const int master = model.nodes().master(node);
          const auto at = moved.find(master);
          const Vec6 motion = at == moved.end() ? Vec6(Vec6::Zero()) : at->second;
          const Vec3 arm = Vec3(model::NodeTable::slots(state.next, master).col(0)) - x0;
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

std::string PostMortem::mechanism(const model::State& state, const Vector& motion) const {
  const std::map<int, Vec6> moved = moved_nodes(state, motion);
  if (resistance(motion) > least_resistance) {
    return "Likely cause: stiffnesses or masses that differ too much in size for double "
           "precision.\n"
           "Beside the stiffest, almost nothing resists this motion:\n" +
           largest_motions(moved) +
           "Try: check units; make what is stiff or heavy less so, or rigid.";
  }
  return "Likely cause: a mechanism. Nothing resists this motion:\n" + largest_motions(moved) +
         rigid_motions(state, moved) +
         "Try: add a support or a joint that holds it, or give the section stiffness.";
}

std::string PostMortem::massless(const model::State& state, const Vector& motion) const {
  const std::string motions = largest_motions(moved_nodes(state, motion));
  return (motions.empty()
              ? "The mass matrix is singular: nothing has mass.\n"
              : "The mass matrix is singular: this motion has no inertia.\n" + motions) +
         "Try: give every structure a density or mass, and rotary inertia to its nodes.";
}

void PostMortem::refuse_massless(Context& context, const model::State& state) {
  const PostMortem diagnosis(context);
  Vector direction(context.system.layout().row_map());
  context.linear.weakest_direction(direction);
  // multipliers have no nodes
  const auto values = values_of(direction);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto unknown = direction.getMap()->getGlobalElement(static_cast<int>(i));
    const Place place = diagnosis.place_of(static_cast<int>(unknown));
    if (place.block.kind == model::BlockKind::multipliers) values[i] = 0.0;
  }
  throw NumericalError(context.system.comm().broadcast(diagnosis.massless(state, direction)));
}

std::string PostMortem::history() const {
  std::string text = "Last steps:\n";
  for (const StepReport& a : attempts_) {
    text += fmt::format("  {} {:<12.8g} increment {:<10.3g} {:>3} iterations  {}\n", time_word(),
                        a.time, a.increment, a.outcome.iterations, solver::describe(a.outcome.end));
  }
  if (!attempts_.empty()) {
    text += "Force residual of the last attempt, relative:";
    for (const solver::IterationRecord& r : attempts_.back().outcome.history) {
      text += fmt::format(" {:.1e}", r.force);
    }
    text += '\n';
  }
  return text;
}

std::string PostMortem::worst_rows() const {
  std::string text = "Largest residuals of the last attempt:\n";
  for (const Entry& entry : worst_) {
    text += fmt::format("  {:<40} {:+.3e}\n", entry.name, entry.value);
  }
  return text;
}

std::string PostMortem::cause(model::State& state, const Stencil& stencil) {
  if (level_step_ == 0.0) return dynamic_cause();
  if (!std::isfinite(attempts_.back().final_time)) return path_cause(state, stencil);
  const double now = load_flexibility(state, stencil, level_step_);
  const double remaining = std::isfinite(now) && now != 0.0 ? first_flexibility_ / now : 0.0;
  if (std::isfinite(first_flexibility_) && first_flexibility_ > 0.0 && remaining < 0.15) {
    return fmt::format(
        "Likely cause: a limit point. At level {:.6g} the structure keeps {:.1f} % of its initial\n"
        "stiffness against this load; the load cannot grow further on this path.\n"
        "Try: an analysis of type 'Path', which goes on beyond, or end below this level.",
        state.time, 100.0 * remaining);
  }
  Vector direction(context_.system.layout().row_map());
  const double ratio = context_.linear.weakest_direction(direction);
  if (ratio < singular_ratio || attempts_.back().outcome.end == solver::StepEnd::singular) {
    return singular_cause(state, direction);
  }
  if (attempts_.back().outcome.end == solver::StepEnd::out_of_range) {
    return "Likely cause: an element turns too far, or inside out.\n"
           "Try: smaller steps, 'Line Search' = Backtrack, more elements.";
  }
  return fmt::format(
      "Likely cause: the iteration does not find the next equilibrium although the structure "
      "keeps\n"
      "{:.1f} % of its stiffness; a bifurcation or a sudden change of the load may be near.\n"
      "Try: more steps, more elements, 'Line Search' = Backtrack, or a small imperfection.",
      100.0 * remaining);
}

std::string PostMortem::path_cause(model::State& state, const Stencil& stencil) {
  if (attempts_.back().outcome.end == solver::StepEnd::out_of_range) {
    return "Likely cause: an element turns too far, or inside out.\nTry: more elements.";
  }
  std::string text =
      "Likely cause: the path bends more sharply than the shortest step can follow, crosses\n"
      "another path, or ends where loads or prescribed motions do.\n";
  const double flexibility = load_flexibility(state, stencil, level_step_);
  if (is_factored_ && std::isfinite(flexibility)) {
    Vector direction(context_.system.layout().row_map());
    context_.linear.weakest_direction(direction);
    text += "Here the structure is weakest against this motion, in which it may buckle:\n" +
            largest_motions(moved_nodes(state, direction));
  }
  return text +
         "Try: a smaller 'Smallest Length' or 'First Increment', another 'Control', a mesh that\n"
         "resolves this motion, or a small imperfection.";
}

std::string PostMortem::dynamic_cause() const {
  if (attempts_.back().outcome.end == solver::StepEnd::out_of_range) {
    return "Likely cause: an element turns too far in a step, or inside out.\n"
           "Try: a smaller step, more elements.";
  }
  if (attempts_.back().outcome.end == solver::StepEnd::turned_too_far) {
    return "Likely cause: a body spins too fast for the steps.\nTry: a smaller step.";
  }
  return "Likely cause: a sudden change of load, or motion that the mesh cannot follow.\n"
         "Try: a smaller step, 'Line Search' = Backtrack, more elements, or some dissipation.";
}

void PostMortem::give_up(model::State& state, const Stencil& stencil) {
  const StepReport& last = attempts_.back();
  const bool end_is_known = std::isfinite(last.final_time);
  std::string text =
      fmt::format("No equilibrium beyond {} {:.8g}{}: {}.\n", time_word(), state.time,
                  end_is_known ? fmt::format(" of {:.8g}", last.final_time) : std::string(),
                  solver::describe(last.outcome.end));
  text += history() + worst_rows();
  const bool not_finite = last.outcome.end == solver::StepEnd::not_finite;
  if (not_finite) {
    text += beyond_range;
  } else {
    text += cause(state, stencil);
  }
  text = context_.system.comm().broadcast(text);
  if (not_finite) throw NonFiniteError(text);
  throw NumericalError(text);
}

}  // namespace culm::analysis
