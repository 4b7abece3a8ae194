#include "both_frames.hpp"

#include <utility>

namespace culm::load {
namespace {

void add_type(model::BuilderRegistry& registry, const std::string& type, Schema schema, Axes axes,
              MakeLoad make) {
  registry.add(type, std::move(schema), [=](const Options& options, model::BuildContext& context) {
    auto function = model::find_function(options, context, "Function", model::Follows::signals);
    if (!function) return;
    const bool turns = axes == Axes::directors && options.flag("Turning");
    auto load =
        make({options, context, effect_of(type, options), *std::move(function), axes, turns});
    if (load) context.model.add_load(std::move(load));
  });
}

}  // namespace

Vec3 LoadRequest::components(const Vec3& vector, const model::Marker& point) const {
  if (turns || axes == Axes::space) return vector;
  Mat3 directors = Mat3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    directors += point.weights[a] *
                 model::NodeTable::slots(nodes().reference(), point.nodes[a]).rightCols<3>();
  }
  return directors * vector;
}

void register_both_frames(model::BuilderRegistry& registry, const LoadType& type,
                          const Schema& fields, MakeLoad make) {
  const auto schema = [&](const std::string& name, const char* frame_doc, const char* components) {
    Schema result(name, type.doc + frame_doc);
    result.add_all(fields);
    if (!type.quantity.empty()) {
      result.add(model::vector_field(type.quantity, type.unit, components));
    }
    return result.add(model::function_field("Ramp"));
  };
  add_type(registry, type.name,
           schema(type.name, ", fixed in space.", "Components in space at function value 1."),
           Axes::space, make);
  const std::string follower = "Follower " + type.name;
  add_type(registry, follower,
           schema(follower, ", turning with the directors.",
                  "Components in the directors at function value 1.")
               .add(flag("Turning",
                         "Whether it turns; if not, it keeps the direction that the directors of "
                         "the reference give it.")
                        .optional(true)),
           Axes::directors, make);
}

void refuse_following_moment(const LoadRequest& request, const std::vector<int>& nodes) {
  if (request.axes == Axes::space) return;
  for (int node : nodes) {
    if (request.nodes().kind(node) != NodeKind::node6) continue;
    request.context.issues.add(request.options.where(),
                               "node '" + request.context.model.node_name(node) +
                                   "' of a shell has one director, which no moment can follow; a "
                                   "Moment fixed in space is possible");
    return;
  }
}

model::Effect effect_of(const std::string& type, const Options& options) {
  return {type, options.name()};
}

Field offset_field() {
  return model::vector_field("Offset", "m", "From the node to the point, in its directors.")
      .optional({0.0, 0.0, 0.0});
}

}  // namespace culm::load
