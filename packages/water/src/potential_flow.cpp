#include "potential_flow.hpp"

#include <culm/joint/triad_nodes.hpp>
#include <culm/water/potential_load.hpp>

#include "find_sea.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

namespace culm::water {
namespace {

Schema schema() {
  return Schema("Potential Flow",
                "Water about a large body by linear potential flow, from files of WAMIT: buoyancy "
                "and restoring forces, waves, added mass and the waves that the body makes.")
      .add(model::node_field())
      .add(flow::flow_field())
      .add(model::function_field("Constant"))
      .add(text("File Name",
                "The file NAME.1 of added mass and damping, relative to the deck; NAME.3 and "
                "NAME.hst stand beside it. Their origin is the node, their axes are those of "
                "space."))
      .add(number("Length", "m", "By which the numbers of the files are made without units, ULEN.")
               .positive()
               .optional(1.0))
      .add(number("Volume", "m^3", "Displaced in the reference.").non_negative())
      .add(model::vector_field("Centre", "m", "Of this volume, from the node, in space.")
               .optional({0.0, 0.0, 0.0}))
      .add(integer("Poles", "Pairs of poles by which the radiated waves are fitted; 0: none.")
               .between(0, 40)
               .optional(5))
      .add(number("Fit", "1",
                  "Largest error of this fit, root of the mean squares over that of the files, and "
                  "largest damping added so that the body never gains energy, over its own.")
               .positive()
               .optional(0.02));
}

// Waves outside of the files are not extrapolated.
bool covers(const PotentialBody& body, const Sea& sea, const Options& options,
            InputIssues& issues) {
  if (sea.waves().empty()) return true;
  const double low = body.excitation.empty() ? 0.0 : body.excitation.front().frequency;
  const double high = body.excitation.empty() ? 0.0 : body.excitation.back().frequency;
  constexpr double near = 1e-9;
  for (const Wave& wave : sea.waves()) {
    if (wave.frequency < low * (1.0 - near) || wave.frequency > high * (1.0 + near)) {
      issues.add(options.where("File Name"),
                 fmt::format("has waves from {:.4g} to {:.4g} rad/s, but '{}' has one of {:.4g} "
                             "rad/s",
                             low, high, options.text("Flow"), wave.frequency));
      return false;
    }
    const double heading = std::atan2(wave.direction.y(), wave.direction.x());
    if (!heading_in(body, heading)) {
      issues.add(
          options.where("File Name"),
          fmt::format("has waves with headings from {:.4g} to {:.4g} rad, but '{}' has one "
                      "of {:.4g} rad",
                      body.headings.front(), body.headings.back(), options.text("Flow"), heading));
      return false;
    }
  }
  return true;
}

// Fits what is radiated; an issue if the fit is bad, or would make much energy.
bool fit(const Options& options, FloatingBody& body, InputIssues& issues) {
  const int pairs = options.integer("Poles");
  if (pairs == 0) return true;
  const int least = 2 * pairs + 1;
  if (static_cast<int>(body.flow.radiation.size()) < least) {
    issues.add(options.where("Poles"),
               fmt::format("{} pairs need {} frequencies in the file, which has {}", pairs, least,
                           body.flow.radiation.size()));
    return false;
  }
  body.radiation = fit_radiation(body.flow, pairs);
  if (body.radiation.error > options.number("Fit")) {
    issues.add(
        options.where("Poles"),
        fmt::format("the fit with {} pairs has an error of {:.2g}, 'Fit' allows {:.2g}: take "
                    "more poles, or allow more",
                    pairs, body.radiation.error, options.number("Fit")));
    return false;
  }
  if (body.radiation.creates > options.number("Fit")) {
    issues.add(options.where("Poles"),
               fmt::format("the fit with {} pairs makes energy: its damping falls to {:.2g} of the "
                           "largest, 'Fit' allows {:.2g}; take another number of poles",
                           pairs, -body.radiation.creates, -options.number("Fit")));
    return false;
  }
  return true;
}

void make_potential_flow(const Options& options, flow::FluidContext& context) {
  model::BuildContext& build = context.build;
  const auto sea = find_sea(options, context);
  const auto function = model::find_function(options, build);
  const std::vector<int> nodes = model::select_nodes(options, "Node", build);
  if (!sea || !function || nodes.empty()) return;
  if (!joint::have_triads(nodes, "Node", options, build)) return;
  if (nodes.size() > 1) {
    build.issues.add(options.where("Node"),
                     fmt::format("must be one node, that of the body, got {}", nodes.size()));
    return;
  }
  const Site& site = sea->site();
  if ((site.up - Vec3::UnitZ()).norm() > 1e-12) {
    build.issues.add(options.where("Flow"), "must be a sea with 'Up' = {0, 0, 1}");
    return;
  }
  for (const auto& batch : build.model.loads()) {
    const auto* other = dynamic_cast<const PotentialLoad*>(batch.get());
    if (other == nullptr || other->node() != nodes.front()) continue;
    build.issues.add(options.where("Node"),
                     fmt::format("{} acts on this body: two loads would carry the water twice",
                                 other->effect().quoted()));
    return;
  }
  FloatingBody body;
  const Where file = options.where("File Name");
  const auto path = std::filesystem::path(file.file).parent_path() / options.text("File Name");
  body.flow =
      read_wamit(path.string(), {site.density, site.gravity, options.number("Length")}, file);
  if (!covers(body.flow, *sea, options, build.issues)) return;
  if (!fit(options, body, build.issues)) return;
  const Vec3 centre = model::vector(options, "Centre");
  const Vec3 lift = site.density * site.gravity * options.number("Volume") * Vec3::UnitZ();
  body.rest << lift, centre.cross(lift);
  build.model.add_load(std::make_unique<PotentialLoad>(
      model::Effect("Potential Flow", options.name()), build.model.nodes(), *function, sea,
      nodes.front(), std::move(body)));
}

}  // namespace

void register_potential_flow(flow::FluidLoadRegistry& registry) {
  registry.add("Potential Flow", schema(), make_potential_flow);
}

}  // namespace culm::water
