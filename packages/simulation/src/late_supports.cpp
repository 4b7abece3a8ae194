#include "late_supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::simulation {
namespace {

// Over the size of the model, or of a director: what tolerances of equations before may leave.
constexpr double least_gap = 1e-6;

bool is_equation(const model::Constraint& c, const model::Model& model) {
  return std::ranges::any_of(model.equations(), [&](const model::Constraint& equation) {
    return equation.name == c.name && equation.type == c.type && equation.nodes == c.nodes;
  });
}

// Links do not know where in the deck they stand.
Where where_of(const model::Constraint& c, const Options& constraints) {
  for (const Options& entry : constraints.entries()) {
    if (entry.name() == c.name) return entry.where();
  }
  return c.where;
}

// Whether a row is about places, hence a length.
bool is_about_places(const model::ConstraintRow& row) {
  for (std::size_t slot = 0; slot < row.alpha.size(); slot += 4) {
    if (row.alpha[slot] != 0.0) return true;
  }
  return false;
}

// What a constraint misses most: a length [m], or a share of a director.
struct Gap {
  double value = 0.0;
  bool is_length = false;
};

std::string describe(const Gap& gap) {
  return fmt::format("{:.3g}{}", gap.value, gap.is_length ? " m" : " rad");
}

Gap gap_of(const model::Constraint& c, const std::vector<model::ConstraintRow>& rows,
           const model::Coordinates& q, double length) {
  Gap most;
  double share = least_gap;
  const Eigen::Matrix3Xd slots = model::slots_of(c, q);
  for (const model::ConstraintRow& row : rows) {
    const bool is_length = is_about_places(row);
    const double value = std::abs(model::row_value(row, slots));
    if (value <= share * (is_length ? length : 1.0)) continue;
    share = value / (is_length ? length : 1.0);
    most = {value, is_length};
  }
  return most;
}

}  // namespace

void refuse_left_supports(const model::Model& model, const model::Coordinates& q,
                          const Options& constraints, const std::string& analysis) {
  InputIssues issues;
  for (const model::Constraint& c : model.constraints()) {
    if (!c.fix && !c.link) continue;
    const Gap gap = gap_of(c, c.rows, q, model.length());
    if (gap.value == 0.0 || is_equation(c, model)) continue;
    issues.add(
        where_of(c, constraints),
        fmt::format("'{}' begins where {} is off '{}' by {}: it takes unknowns away and leads "
                    "nothing back. Let it act in the analyses before, or prescribe the way back; "
                    "with 'Solver' / 'Form' = 'Multipliers' it is an equation, which does",
                    analysis, model.node_name(c.link ? c.link->slave : c.nodes.front()), c.name,
                    describe(gap)));
  }
  issues.throw_if_any();
}

std::vector<std::string> open_joints(const model::Model& model, const model::Coordinates& q,
                                     double time, const std::string& analysis) {
  std::vector<std::string> sentences;
  for (const model::Constraint& c : model.equations()) {
    if (c.follow || c.is_structural) continue;
    std::vector<model::ConstraintRow> rows = c.rows;
    if (c.drive) c.drive(time, rows);
    const Gap gap = gap_of(c, rows, q, model.length());
    if (gap.value == 0.0) continue;
    sentences.push_back(fmt::format(
        "'{}' begins where {} '{}' does not hold, by {}: the first step closes this at once, and "
        "what is moved by it gets velocities that depend on the step",
        analysis, c.type, c.name, describe(gap)));
  }
  return sentences;
}

}  // namespace culm::simulation
