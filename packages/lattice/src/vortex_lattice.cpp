#include <culm/lattice/lattice_load.hpp>
#include <culm/lattice/register_lattice.hpp>
#include <culm/model/size_budget.hpp>

#include "placement.hpp"
#include "surfaces.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

namespace culm::lattice {
namespace {

Schema wake_schema() {
  return Schema("Wake", "The vortex sheets behind the trailing edges, in dynamics.")
      .add(choice("Motion", {"Prescribed", "Free"},
                  "Moves with the undisturbed flow, or with all that is induced as well.")
               .optional("Prescribed"))
      .add(integer("Rows", "Largest number of rows; one is shed per step, the oldest is lost.")
               .at_least(1)
               .optional(200))
      .add(number("Core", "1", "Radius of the vortex cores, over the smaller side of a panel.")
               .non_negative()
               .optional(0.1))
      .add(number("Core Growth", "m^2/s",
                  "Effective viscosity by which the square of the radius grows with age.")
               .non_negative()
               .optional(0.0));
}

Schema schema() {
  return Schema("Vortex Lattice",
                "Lifting surfaces on beams and shells by vortex rings: steady in statics, with a "
                "wake that grows by a row per step in dynamics.")
      .add(flow::flow_field())
      .add(model::vector_field("Mirror", "1",
                               "Normal of a plane of symmetry through the origin, such as the "
                               "middle of an aircraft or the ground.")
               .optional())
      .add(choice("Forces", {"Joukowski", "Bernoulli"},
                  "On vortex segments, with suction at leading edges, or by pressure jumps, "
                  "normal to the panels.")
               .optional("Joukowski"))
      .add(choice(
               "Tangent", {"Apparent Mass", "Whole"},
               "What Newton's method and linear analyses know of the change of the forces: half "
               "of the mass of the air, which linear analyses leave out, or all that follows from "
               "the motion of all nodes of the surfaces, which couples these with each other.")
               .optional("Apparent Mass"))
      .list("Surfaces", Schema("Surfaces", "Lifting surfaces by name. Wakes act on all of them.")
                            .entries(surface_schema())
                            .check([](const Options& list, InputIssues& issues) {
                              if (list.entries().empty()) {
                                issues.add(list.where(), "must hold at least one surface");
                              }
                            }))
      .list("Wake", wake_schema(), Presence::defaulted);
}

LatticeSetting setting_of(const Options& options) {
  const Options& wake = options.list("Wake");
  LatticeSetting setting;
  if (options.text("Forces") == "Bernoulli") setting.forces = ForceRule::bernoulli;
  if (wake.text("Motion") == "Free") setting.wake = WakeMotion::free;
  setting.rows = wake.integer("Rows");
  setting.core = {wake.number("Core"), wake.number("Core Growth")};
  return setting;
}

// Matrices of all rings on each other and their factors, and what is kept of wakes: in the accepted
// state, in the step and in checkpoints. Before anything is made of that size.
void take_memory(const Options& options, flow::FluidContext& context) {
  constexpr double number = 8.0;
  constexpr double copies = 4.0;
  double rings = 0.0, strips = 0.0;
  for (const Options& entry : options.list("Surfaces").entries()) {
    const auto& panels = entry.integers("Panels");
    rings += static_cast<double>(panels[0]) * panels[1];
    strips += panels[1] + 1.0;
  }
  const double rows = options.list("Wake").integer("Rows");
  model::MemoryNeed need;
  need.elements = number * (copies * rings * rings + copies * 5.0 * rows * strips);
  model::refuse_above(
      context.memory, need,
      fmt::format("asks for {:.0f} panels with a wake of {:.0f} rows, which", rings, rows),
      options.where());
}

// The whole tangent, between all nodes, and its blocks in the matrix with factors.
void take_memory_of_tangent(const LatticeLoad& load, const Options& options,
                            flow::FluidContext& context) {
  constexpr double number = 8.0, blocks = 12.0 * 12.0 + 2.0 * 6.0 * 6.0;
  const auto nodes = static_cast<double>(load.nodes().size());
  model::MemoryNeed need;
  need.elements = number * blocks * nodes * nodes;
  model::refuse_above(context.memory, need,
                      fmt::format("couples {:.0f} nodes with each other, which", nodes),
                      options.where("Tangent"));
}

void build(const Options& options, flow::FluidContext& context) {
  take_memory(options, context);
  const flow::SharedFlow flow = flow::find_flow(options, context);
  std::optional<Vec3> mirror;
  if (options.has("Mirror")) {
    mirror = model::vector(options, "Mirror");
    if (mirror->norm() == 0.0) {
      context.build.issues.add(options.where("Mirror"), "must not be zero");
      return;
    }
    mirror->normalize();
  }
  std::vector<SurfaceGrid> surfaces;
  std::vector<std::string> names;
  bool is_sound = flow != nullptr;
  for (const Options& entry : options.list("Surfaces").entries()) {
    auto surface = read_surface(entry, context.build);
    is_sound = is_sound && surface;
    if (surface) surfaces.push_back(std::move(*surface));
    names.push_back(entry.name());
  }
  if (!is_sound) return;
  const model::NodeTable& nodes = context.build.model.nodes();
  const auto tangent =
      options.text("Tangent") == "Whole" ? LatticeTangent::whole : LatticeTangent::apparent_mass;
  auto load = std::make_unique<LatticeLoad>(model::Effect("Vortex Lattice", options.name()), nodes,
                                            std::move(surfaces), mirror, flow, setting_of(options),
                                            tangent);
  if (tangent == LatticeTangent::whole) take_memory_of_tangent(*load, options, context);
  load->limit_linearisations(context.memory, options.where("Tangent"));
  if (const auto wrong =
          find_misplaced(load->lattice().bound(), load->grid(nodes.reference()), names)) {
    context.build.issues.add(options.list("Surfaces").entries()[wrong->surface].where(),
                             wrong->text);
    return;
  }
  flow::refuse_rotating_frame(options, load->nodes(), context);
  context.build.model.add_load(std::move(load));
}

}  // namespace

void register_lattice(flow::FluidLoadRegistry& registry) {
  registry.add("Vortex Lattice", schema(), build);
}

}  // namespace culm::lattice
