#include <culm/base/nearest.hpp>
#include <culm/joint/triad_nodes.hpp>
#include <culm/rotor/register_rotor.hpp>
#include <culm/rotor/rotor_load.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace culm::rotor {
namespace {

Schema rotor_schema() {
  return Schema("Rotor",
                "What a turning rotor induces at the strips of its blades, by blade element and "
                "momentum.")
      .add(text("Hub", "The node that carries the axis, at the centre of the rotor."))
      .add(model::vector_field("Axis", "1", "Axis downwind in the reference, of any length."))
      .add(texts("Blades",
                 "Names of loads of type Strip, one per blade, each from the root to the tip.")
               .min_size(1))
      .add(choice("Induction", {"None", "Frozen", "Steady", "Dynamic"},
                  "None; that of the first step of a motion; by the balance of each step; "
                  "or behind it with the lags of the wake.")
               .optional("Dynamic"))
      .add(texts("Losses", "Of Prandtl, at the ends of the blades.")
               .one_of({"Tip", "Hub"})
               .optional({"Tip", "Hub"}))
      .add(flag("Drag Induces", "Whether drag counts in the balance of momentum.").optional(true))
      .add(choice("Yaw", {"None", "Pitt Peters"},
                  "More induction downwind, where the wind is at an angle to the axis.")
               .optional("Pitt Peters"));
}

RotorModel model_of(const Options& options) {
  RotorModel model;
  const std::string& induction = options.text("Induction");
  if (induction == "None") model.follow = Follow::none;
  if (induction == "Frozen") model.follow = Follow::frozen;
  if (induction == "Steady") model.follow = Follow::steady;
  const std::vector<std::string>& losses = options.texts("Losses");
  model.losses.tip = std::ranges::find(losses, "Tip") != losses.end();
  model.losses.hub = std::ranges::find(losses, "Hub") != losses.end();
  model.drag_induces = options.flag("Drag Induces");
  model.skewed_wake = options.text("Yaw") == "Pitt Peters";
  return model;
}

// Strips that no rotor has yet; empty, and issues, if any is missing.
std::vector<strip::StripLoad*> find_blades(const Options& options, strip::StripContext& context) {
  InputIssues& issues = context.fluids.build.issues;
  std::vector<std::string> known;
  for (const auto& [name, strip] : context.strips) known.push_back(name);
  std::vector<strip::StripLoad*> blades;
  bool is_sound = true;
  for (const std::string& name : options.texts("Blades")) {
    const auto found = context.strips.find(name);
    std::string issue;
    if (found == context.strips.end()) {
      issue = "no strips '" + name + "'" + did_you_mean(name, known);
    } else if (found->second->inducer() != nullptr ||
               std::ranges::find(blades, found->second) != blades.end()) {
      issue = "'" + name + "' is a blade of a rotor already";
    } else if (found->second->size() < 2) {
      issue = "'" + name + "' must have at least two stations, from the root to the tip";
    } else if (!blades.empty() && &blades.front()->flow() != &found->second->flow()) {
      issue = "'" + name + "' stands in another flow than '" + options.texts("Blades")[0] +
              "'; a rotor has one";
    }
    if (issue.empty()) {
      blades.push_back(found->second);
    } else {
      issues.add(options.where("Blades"), issue);
      is_sound = false;
    }
  }
  return is_sound ? blades : std::vector<strip::StripLoad*>{};
}

void build(const Options& options, strip::StripContext& context) {
  model::BuildContext& build = context.fluids.build;
  const std::vector<int> nodes = model::select_nodes(options, "Hub", build);
  const std::vector<strip::StripLoad*> blades = find_blades(options, context);
  const Vec3 axis = model::vector(options, "Axis");
  if (axis.norm() == 0.0) build.issues.add(options.where("Axis"), "must not be zero");
  if (nodes.size() > 1) build.issues.add(options.where("Hub"), "must name one node");
  if (nodes.size() != 1 || blades.empty() || axis.norm() == 0.0) return;
  if (!joint::have_triads(nodes, "Hub", options, build)) return;
  const auto frames = model::rotations_of(build.model, nodes);
  for (const strip::StripLoad* blade : blades) {
    if (model::rotations_of(build.model, blade->stations().front().point.nodes) == frames) continue;
    build.issues.add(options.where("Hub"),
                     "a load 'Rotating Frame' turns either the hub or the blade of '" +
                         blade->effect().name + "': name both in 'Structures' there, or none");
    return;
  }
  const auto slots = model::NodeTable::slots(build.model.nodes().reference(), nodes.front());
  const RotorHub hub{nodes.front(), slots.rightCols<3>().transpose() * axis.normalized()};
  build.model.add_load(std::make_unique<RotorLoad>(
      model::Effect("Rotor", options.name()), build.model.nodes(), hub, blades, model_of(options)));
}

}  // namespace

void register_rotors(strip::StripRegistry& registry) {
  registry.add("Rotor", rotor_schema(), [](const Options& options, strip::StripContext& context) {
    // strips may stand behind the rotor in the deck
    context.fluids.after_all_loads([&options, &context] { build(options, context); });
  });
}

}  // namespace culm::rotor
