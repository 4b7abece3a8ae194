#include <culm/joint/triad_nodes.hpp>

#include "link_type.hpp"
#include "types.hpp"

namespace culm::load {
namespace {

std::vector<Link> torsion_links(const Options& options, model::BuildContext& context) {
  const auto nodes = joint::select_two_nodes(options, context);
  if (!nodes || !joint::have_triads({(*nodes)[0]}, "First", options, context) ||
      !joint::have_triads({(*nodes)[1]}, "Second", options, context)) {
    return {};
  }
  const joint::MarkerPair pair(context.model.nodes(), (*nodes)[0], (*nodes)[1], Vec3::Zero());
  return {angle_link(pair, model::vector(options, "Axis").normalized())};
}

std::unique_ptr<LinkLaw> make_drive(const Options& options, model::BuildContext& context) {
  auto function = model::find_function(options, context, "Function", model::Follows::signals);
  if (!function) return nullptr;
  return std::make_unique<DriveLaw>(options.number("Moment"), *std::move(function));
}

}  // namespace

void register_torsion(model::BuilderRegistry& registry) {
  Schema fields("");
  fields.add(model::node_field("First", "Node that the angle is measured from."))
      .add(model::node_field("Second", "The other node of the joint."));
  joint::add_direction("Axis", "Axis of the joint in the reference, of any length.", fields);
  register_spring_and_damper(
      registry, {"Torsion", "on the angle of a revolute joint, which counts full turns.", fields,
                 LinkUnits::angles(), torsion_links});
  register_link(registry,
                Schema("Torsion Drive",
                       "Moment on the second node of a revolute joint, and its "
                       "opposite on the first.")
                    .add_all(fields)
                    .add(number("Moment", "N m", "Moment at function value 1."))
                    .add(model::function_field("Ramp")),
                torsion_links, make_drive);
}

}  // namespace culm::load
