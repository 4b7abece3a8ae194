#include "both_frames.hpp"

#include <utility>

namespace culm::load {
namespace {

void add_type(model::BuilderRegistry& registry, const std::string& type, Schema schema, Frame frame,
              MakeLoad make) {
  registry.add(type, std::move(schema), [=](const Options& options, model::BuildContext& context) {
    auto function = model::find_function(options, context);
    if (!function) return;
    auto load = make({options, context, effect_name(type, options), *std::move(function), frame});
    if (load) context.model.add_load(std::move(load));
  });
}

}  // namespace

void register_both_frames(model::BuilderRegistry& registry, const LoadType& type,
                          const Schema& fields, MakeLoad make) {
  const auto add = [&](const std::string& name, const char* frame_doc, const char* components,
                       Frame frame) {
    add_type(registry, name,
             Schema(name, type.doc + frame_doc)
                 .add_all(fields)
                 .add(model::vector_field(type.quantity, type.unit, components))
                 .add(model::function_field("Ramp")),
             frame, make);
  };
  add(type.name, ", fixed in space.", "Components in space at function value 1.", Frame::space);
  add("Follower " + type.name, ", turning with the directors.",
      "Components in the directors at function value 1.", Frame::directors);
}

void check_components(const std::string& parameter, const std::vector<int>& nodes,
                      const Options& options, model::BuildContext& context) {
  if (model::vector(options, parameter).tail<2>().isZero(0.0)) return;
  for (int node : nodes) {
    if (context.model.nodes().kind(node) != NodeKind::node6) continue;
    context.issues.add(options.where(parameter),
                       "node '" + context.model.node_name(node) +
                           "' of a shell has one director: only the first component may differ "
                           "from zero");
    return;
  }
}

void refuse_following_moment(const LoadRequest& request, const std::vector<int>& nodes) {
  if (request.frame == Frame::space) return;
  for (int node : nodes) {
    if (request.nodes().kind(node) != NodeKind::node6) continue;
    request.context.issues.add(request.options.where(),
                               "node '" + request.context.model.node_name(node) +
                                   "' of a shell has one director, which no moment can follow; a "
                                   "Moment fixed in space is possible");
    return;
  }
}

std::string effect_name(const std::string& type, const Options& options) {
  return options.name().empty() ? type : type + ", " + options.name();
}

Field offset_field() {
  return model::vector_field("Offset", "m", "From the node to the point, in its directors.")
      .optional({0.0, 0.0, 0.0});
}

}  // namespace culm::load
