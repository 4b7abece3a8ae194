#include <culm/joint/marker_pair.hpp>
#include <culm/joint/triad_nodes.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <utility>

namespace culm::joint {

MarkerPair::MarkerPair(const Anchor& first, const Anchor& second, const Vec3& point)
    : anchors_{first, second},
      nodes_(first.nodes()),
      point_(point),
      q_(3, first.num_slots() + second.num_slots()) {
  nodes_.insert(nodes_.end(), second.nodes().begin(), second.nodes().end());
  q_ << first.reference(), second.reference();
}

model::SlotSum MarkerPair::widened(int anchor, const model::SlotSum& sum, double factor) const {
  model::SlotSum result(static_cast<std::size_t>(q_.cols()), 0.0);
  const std::size_t first = anchor == 0 ? 0 : static_cast<std::size_t>(anchors_[0].num_slots());
  for (std::size_t s = 0; s < sum.size(); ++s) result[first + s] = factor * sum[s];
  return result;
}

model::SlotSum MarkerPair::vector(int anchor, const Vec3& v) const {
  return widened(anchor, anchors_[static_cast<std::size_t>(anchor)].vector(v), 1.0);
}

model::SlotSum MarkerPair::gap() const {
  const auto point_on = [&](int anchor, double factor) {
    const Anchor& on = anchors_[static_cast<std::size_t>(anchor)];
    model::SlotSum point = on.point();
    const model::SlotSum arm = on.vector(point_ - on.position());
    for (std::size_t s = 0; s < point.size(); ++s) point[s] += arm[s];
    return widened(anchor, point, factor);
  };
  model::SlotSum gap = point_on(0, 1.0);
  const model::SlotSum second = point_on(1, -1.0);
  for (std::size_t s = 0; s < gap.size(); ++s) gap[s] += second[s];
  return gap;
}

model::Constraint MarkerPair::joint() const {
  model::Constraint joint;
  joint.nodes = nodes_;
  joint.is_internal = true;
  return joint;
}

void MarkerPair::add_point_rows(model::Constraint& joint) const {
  for (int axis = 0; axis < 3; ++axis) {
    joint.rows.push_back(model::linear_row(Vec3::Unit(axis), gap(), q_));
  }
}

void MarkerPair::add_parallel_rows(const Vec3& axis, model::Constraint& joint) const {
  const Vec3 across = any_normal(axis);
  add_angle_row(across, axis, joint);
  add_angle_row(axis.cross(across), axis, joint);
}

void MarkerPair::add_line_rows(const Vec3& axis, model::Constraint& joint) const {
  const Vec3 across = any_normal(axis);
  for (const Vec3& e : {across, Vec3(axis.cross(across))}) {
    joint.rows.push_back(model::product_row(vector(0, e), gap(), q_));
  }
}

void MarkerPair::add_angle_row(const Vec3& a, const Vec3& b, model::Constraint& joint) const {
  joint.rows.push_back(model::product_row(vector(0, a), vector(1, b), q_));
}

Schema pair_schema(const std::string& type, const std::string& doc) {
  return Schema(type, doc)
      .add(model::point_field("First", "One point of the joint."))
      .add(model::point_field("Second", "The other point."))
      .add(model::vector_field("Position", "m",
                               "Place of the joint in the reference; the second point if absent.")
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
                         const std::string& doc,
                         model::Constraint (*make)(const MarkerPair& pair)) {
  registry.add(type, pair_schema(type, doc),
               [type, make](const Options& options, model::BuildContext& context) {
                 add_joint(type, options, context, make);
               });
}

void register_axis_joint(model::BuilderRegistry& registry, const std::string& type,
                         const std::string& doc,
                         model::Constraint (*make)(const MarkerPair& pair, const Vec3& axis)) {
  Schema schema = pair_schema(type, doc);
  add_direction("Axis", "Axis in the reference, of any length.", schema);
  registry.add(type, schema, [type, make](const Options& options, model::BuildContext& context) {
    add_joint(type, options, context, [&](const MarkerPair& pair) {
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
               const std::function<model::Constraint(const MarkerPair& pair)>& make) {
  const auto first = model::select_point(options, "First", context);
  const auto second = model::select_point(options, "Second", context);
  if (!first || !second) return;
  if (!have_triads(first->nodes, "First", options, context) ||
      !have_triads(second->nodes, "Second", options, context)) {
    return;
  }
  if (first->nodes == second->nodes && first->weights == second->weights) {
    context.issues.add(options.where("Second"), "must be another node than First");
    return;
  }
  const model::NodeTable& nodes = context.model.nodes();
  const Anchor anchor(nodes, *second);
  const Vec3 point =
      options.has("Position") ? model::vector(options, "Position") : anchor.position();
  model::Constraint joint = make(MarkerPair(Anchor(nodes, *first), anchor, point));
  joint.type = type;
  joint.name = options.name();
  joint.where = options.where();
  context.model.add_constraint(std::move(joint));
}

}  // namespace culm::joint
