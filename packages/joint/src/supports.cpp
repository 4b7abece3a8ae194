#include "supports.hpp"

#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <utility>

namespace culm::joint {

model::Constraint support_of(int node) {
  model::Constraint support;
  support.nodes = {node};
  return support;
}

void add_vector_rows(const model::SlotSum& alpha, const Eigen::Matrix3Xd& q,
                     model::Constraint& constraint) {
  for (int axis = 0; axis < 3; ++axis) {
    constraint.rows.push_back(model::linear_row(Vec3::Unit(axis), alpha, q));
  }
}

void add_axis_rows(const Vec3& axis, const Eigen::Matrix3Xd& q, model::Constraint& constraint) {
  const Vec3 components = q.rightCols<3>().transpose() * axis;
  const Vec3 across = any_normal(axis);
  for (const Vec3& e : {across, Vec3(axis.cross(across))}) {
    constraint.rows.push_back(model::linear_row(e, model::attached_vector(0, 1, components), q));
  }
}

void drive_constant(const Prescribed& motion, model::Constraint& constraint) {
  const double at_rest = constraint.rows.front().constant;
  constraint.drive = [motion, at_rest](double time, std::vector<model::ConstraintRow>& rows) {
    rows.front().constant = at_rest + motion.at(time);
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

std::bitset<6> rotations_across(std::size_t axis) {
  std::bitset<6> fixed(0b111000);
  return fixed.reset(3 + axis);
}

void add_per_node(const std::string& type, const Options& options, model::BuildContext& context,
                  const std::function<model::Constraint(int node)>& make) {
  const std::vector<int> nodes = model::select_nodes(options, "Node", context);
  for (int node : nodes) {
    model::Constraint constraint = make(node);
    constraint.type = type;
    constraint.name = options.name();
    if (nodes.size() > 1) constraint.name += " at " + context.model.node_name(node);
    context.model.add_constraint(std::move(constraint));
  }
}

Schema directed_schema(const std::string& type, const std::string& doc,
                       const std::string& direction, const std::string& direction_doc) {
  return Schema(type, doc)
      .add(model::node_field())
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

std::optional<Prescribed> read_motion(const Options& options, const std::string& amount,
                                      model::BuildContext& context) {
  auto function = model::find_function(options, context);
  if (!function) return {};
  if (!function->is_function_of_time()) {
    context.issues.add(options.where("Function"),
                       "function '" + options.text("Function") +
                           "' has one value per step and cannot prescribe a motion");
    return {};
  }
  return Prescribed{options.number(amount), *std::move(function)};
}

}  // namespace culm::joint
