#include "supports.hpp"

#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace culm::joint {

model::Constraint support_of(const Anchor& anchor) {
  model::Constraint support;
  support.nodes = anchor.nodes();
  return support;
}

void add_vector_rows(const model::SlotSum& alpha, const Anchor& anchor,
                     model::Constraint& constraint) {
  for (int axis = 0; axis < 3; ++axis) {
    constraint.rows.push_back(model::linear_row(Vec3::Unit(axis), alpha, anchor.reference()));
  }
}

void add_axis_rows(const Vec3& axis, const Anchor& anchor, model::Constraint& constraint) {
  const Vec3 across = any_normal(axis);
  for (const Vec3& e : {across, Vec3(axis.cross(across))}) {
    constraint.rows.push_back(model::linear_row(e, anchor.vector(axis), anchor.reference()));
  }
}

void drive_constant(const Prescribed& motion, model::Constraint& constraint) {
  const double at_rest = constraint.rows.front().constant;
  constraint.drive = [motion, at_rest](double time, std::vector<model::ConstraintRow>& rows) {
    rows.front().constant = at_rest + motion.at(time);
  };
}

void drive_constants(const Translation& motion, model::Constraint& constraint) {
  Vec3 at_rest;
  for (std::size_t i = 0; i < 3; ++i) at_rest[static_cast<int>(i)] = constraint.rows[i].constant;
  constraint.drive = [motion, at_rest](double time, std::vector<model::ConstraintRow>& rows) {
    const Vec3 now = at_rest + motion.at(time);
    for (std::size_t i = 0; i < 3; ++i) rows[i].constant = now[static_cast<int>(i)];
  };
}

std::optional<std::size_t> coordinate_axis(const Vec3& n) {
  int largest = 0;
  const double component = n.cwiseAbs().maxCoeff(&largest);
  const double round_off = 1e-14 * component;
  for (int i = 0; i < 3; ++i) {
    if (i != largest && std::abs(n[i]) > round_off) return {};
  }
  return static_cast<std::size_t>(largest);
}

bool is_node(const Anchor& anchor, const Vec3& offset) {
  return anchor.node() >= 0 && offset.isZero(0.0);
}

std::bitset<6> rotations_across(std::size_t axis) {
  std::bitset<6> fixed(0b111000);
  return fixed.reset(3 + axis);
}

Field anchor_field() {
  return model::node_field("Node",
                           "Nodes it acts on, each by itself: 'structure/set', 'structure/number' "
                           "or 'structure'; or a point of a line at a fraction of its length, as "
                           "'beam@0.35'.");
}

namespace {

// A shell node has no triad, and of the directions along which an offset could go only d.
bool can_hold(const std::string& type, const model::Marker& marker, const Options& options,
              model::BuildContext& context, Holds holds) {
  if (context.model.nodes().kind(marker.nodes.front()) != NodeKind::node6) return true;
  const std::string node =
      "node '" + context.model.node_name(marker.nodes.front()) + "' is one of a shell: ";
  if (holds == Holds::triads) {
    context.issues.add(options.where("Node"),
                       node + "it has one director and no triad, which " + type + " needs");
    return false;
  }
  const auto is_offset = [](const auto& parameter) { return parameter.name == "Offset"; };
  const auto& parameters = options.parameters();
  if (std::any_of(parameters.begin(), parameters.end(), is_offset) &&
      !model::vector(options, "Offset").tail<2>().isZero(0.0)) {
    context.issues.add(options.where("Offset"),
                       node + "only the first component, along the director, may differ from zero");
    return false;
  }
  return true;
}

}  // namespace

void add_per_anchor(const std::string& type, const Options& options, model::BuildContext& context,
                    Holds holds,
                    const std::function<model::Constraint(const Anchor& anchor)>& make) {
  std::vector<model::Marker> markers;
  if (options.text("Node").find('@') != std::string::npos) {
    if (auto marker = model::select_point(options, "Node", context)) markers = {*marker};
  } else {
    for (int node : model::select_nodes(options, "Node", context)) {
      markers.push_back(model::marker_at(node));
    }
  }
  for (const model::Marker& marker : markers) {
    if (!can_hold(type, marker, options, context, holds)) return;
    model::Constraint constraint = make(Anchor(context.model.nodes(), marker));
    constraint.type = type;
    constraint.name = options.name();
    constraint.where = options.where();
    if (markers.size() > 1) {
      constraint.name += " at " + context.model.node_name(marker.nodes.front());
    }
    context.model.add_constraint(std::move(constraint));
  }
}

Schema directed_schema(const std::string& type, const std::string& doc,
                       const std::string& direction, const std::string& direction_doc, Field node) {
  return Schema(type, doc)
      .add(std::move(node))
      .add(model::vector_field(direction, "1", direction_doc))
      .check([direction](const Options& options, InputIssues& issues) {
        if (model::vector(options, direction).isZero(0.0)) {
          issues.add(options.where(direction), "must not be zero");
        }
      });
}

Vec3 read_direction(const Options& options, const std::string& parameter) {
  return model::vector(options, parameter).normalized();
}

Field offset_field() {
  return model::vector_field("Offset", "m", "From the node to the held point, in its directors.")
      .optional({0.0, 0.0, 0.0});
}

void add_motion(const std::string& amount, const std::string& unit, const std::string& doc,
                Schema& schema) {
  schema.add(number(amount, unit, doc).optional(0.0)).add(model::function_field("Ramp"));
}

namespace {

// An amount that is left out is zero, and so is what a function makes of it.
void refuse_idle(const Options& options, const std::string& function, const std::string& amount,
                 InputIssues& issues) {
  if (!options.given(function) || options.given(amount)) return;
  issues.add(options.where(function),
             "moves nothing: it is a factor on '" + amount + "', which is missing");
}

std::optional<model::Amplitude> read_function(const Options& options, const std::string& parameter,
                                              model::BuildContext& context,
                                              model::Follows follows = model::Follows::functions) {
  auto function = model::find_function(options, context, parameter, follows);
  if (!function || function->is_function_of_time() || function->signal() != nullptr) {
    return function;
  }
  context.issues.add(options.where(parameter),
                     "function '" + options.text(parameter) +
                         "' has one value per step and cannot prescribe a motion");
  return {};
}

}  // namespace

std::optional<Prescribed> read_motion(const Options& options, const std::string& amount,
                                      model::BuildContext& context, const std::string& function,
                                      model::Follows follows) {
  auto found = read_function(options, function, context, follows);
  if (!found) return {};
  if (found->signal() == nullptr) refuse_idle(options, function, amount, context.issues);
  if (found->signal() != nullptr && options.number(amount) == 0.0) {
    context.issues.add(options.where(), "follows a signal by no amount; '" + amount +
                                            "' is what the signal is times");
    return {};
  }
  return Prescribed{options.number(amount), *std::move(found)};
}

void add_translation(Schema& schema) {
  schema
      .add(model::vector_field("Translation", "m", "Motion in space at function value 1.")
               .optional({0.0, 0.0, 0.0}))
      .add(model::function_field("Ramp"));
}

std::optional<Translation> read_translation(const Options& options, model::BuildContext& context) {
  auto function = read_function(options, "Function", context);
  if (!function) return {};
  refuse_idle(options, "Function", "Translation", context.issues);
  return Translation{model::vector(options, "Translation"), *std::move(function)};
}

}  // namespace culm::joint
