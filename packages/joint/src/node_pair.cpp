#include <culm/joint/node_pair.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <utility>

namespace culm::joint {

NodePair::NodePair(const model::NodeTable& nodes, int first, int second, const Vec3& point)
    : first_(first), second_(second), point_(point), q_(3, 8) {
  q_ << model::NodeTable::slots(nodes.reference(), first),
      model::NodeTable::slots(nodes.reference(), second);
}

model::SlotSum NodePair::vector(int node, const Vec3& v) const {
  const Vec3 components = q_.middleCols<3>(4 * node + 1).transpose() * v;
  return model::attached_vector(node, 2, components);
}

model::SlotSum NodePair::gap() const {
  model::SlotSum gap = vector(0, point_ - q_.col(0));
  const model::SlotSum second = vector(1, point_ - q_.col(4));
  for (std::size_t s = 4; s < 8; ++s) gap[s] = -second[s];
  gap[0] = 1.0;
  gap[4] = -1.0;
  return gap;
}

model::Constraint NodePair::joint() const {
  model::Constraint joint;
  joint.nodes = {first_, second_};
  joint.is_internal = true;
  return joint;
}

void NodePair::add_point_rows(model::Constraint& joint) const {
  for (int axis = 0; axis < 3; ++axis) {
    joint.rows.push_back(model::linear_row(Vec3::Unit(axis), gap(), q_));
  }
}

void NodePair::add_parallel_rows(const Vec3& axis, model::Constraint& joint) const {
  const Vec3 across = any_normal(axis);
  add_angle_row(across, axis, joint);
  add_angle_row(axis.cross(across), axis, joint);
}

void NodePair::add_line_rows(const Vec3& axis, model::Constraint& joint) const {
  const Vec3 across = any_normal(axis);
  for (const Vec3& e : {across, Vec3(axis.cross(across))}) {
    joint.rows.push_back(model::product_row(vector(0, e), gap(), q_));
  }
}

void NodePair::add_angle_row(const Vec3& a, const Vec3& b, model::Constraint& joint) const {
  joint.rows.push_back(model::product_row(vector(0, a), vector(1, b), q_));
}

Schema pair_schema(const std::string& type, const std::string& doc) {
  return Schema(type, doc)
      .add(model::node_field("First", "One node of the joint."))
      .add(model::node_field("Second", "The other node."))
      .add(model::vector_field("Position", "m",
                               "Place of the joint in the reference; the second node if absent.")
               .optional());
}

void add_direction(const std::string& name, const std::string& doc, Schema& schema) {
  schema.add(model::vector_field(name, "1", doc))
      .check([name](const Options& options, InputIssues& issues) {
        if (model::vector(options, name).isZero(0.0)) {
          issues.add(options.where(name), "must not be zero");
        }
      });
}

void register_pair_joint(model::BuilderRegistry& registry, const std::string& type,
                         const std::string& doc, model::Constraint (*make)(const NodePair& pair)) {
  registry.add(type, pair_schema(type, doc),
               [type, make](const Options& options, model::BuildContext& context) {
                 add_joint(type, options, context, make);
               });
}

void register_axis_joint(model::BuilderRegistry& registry, const std::string& type,
                         const std::string& doc,
                         model::Constraint (*make)(const NodePair& pair, const Vec3& axis)) {
  Schema schema = pair_schema(type, doc);
  add_direction("Axis", "Axis in the reference, of any length.", schema);
  registry.add(type, schema, [type, make](const Options& options, model::BuildContext& context) {
    add_joint(type, options, context, [&](const NodePair& pair) {
      return make(pair, model::vector(options, "Axis").normalized());
    });
  });
}

std::optional<std::array<int, 2>> select_two_nodes(const Options& options,
                                                   model::BuildContext& context) {
  const auto node_of = [&](const std::string& parameter) {
    const std::vector<int> nodes = model::select_nodes(options, parameter, context);
    if (nodes.size() > 1) {
      context.issues.add(options.where(parameter),
                         "must name one node, got " + std::to_string(nodes.size()));
    }
    return nodes.size() == 1 ? nodes.front() : -1;
  };
  const int first = node_of("First");
  const int second = node_of("Second");
  if (first < 0 || second < 0) return {};
  if (first == second) {
    context.issues.add(options.where("Second"), "must be another node than First");
    return {};
  }
  return {{first, second}};
}

void add_joint(const std::string& type, const Options& options, model::BuildContext& context,
               const std::function<model::Constraint(const NodePair& pair)>& make) {
  const auto pair = select_two_nodes(options, context);
  if (!pair) return;
  const auto [first, second] = *pair;
  const model::NodeTable& nodes = context.model.nodes();
  const Vec3 point = options.has("Position")
                         ? model::vector(options, "Position")
                         : Vec3(model::NodeTable::slots(nodes.reference(), second).col(0));
  model::Constraint joint = make(NodePair(nodes, first, second, point));
  joint.type = type;
  joint.name = options.name();
  context.model.add_constraint(std::move(joint));
}

}  // namespace culm::joint
