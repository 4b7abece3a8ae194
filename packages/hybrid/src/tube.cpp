#include <culm/base/default_list.hpp>
#include <culm/base/nearest.hpp>
#include <culm/beam/beam_structure.hpp>
#include <culm/hybrid/tube.hpp>
#include <culm/joint/shell_connection.hpp>
#include <culm/material/isotropic.hpp>
#include <culm/material/section.hpp>
#include <culm/material/tube_section.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/build_context.hpp>
#include <culm/shell/shell_structure.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace culm::hybrid {
namespace {

std::vector<double> numbers_of(const Vec3& v) { return {v.begin(), v.end()}; }

Schema tube_schema() {
  Schema schema("Tube",
                "Straight circular tube of an isotropic material, as a beam or as a shell.");
  schema
      .add(choice("Model", {"Beam", "Shell"},
                  "What it is modelled by; both have the nodes 'first' and 'last' at its ends.")
               .optional("Beam"))
      .add(model::vector_field("From", "m", "Centre of the first end."))
      .add(model::vector_field("To", "m", "Centre of the last end."))
      .add(model::vector_field("Up", "1", "d1 is as near to it as the axis allows.")
               .optional({0.0, 0.0, 1.0}))
      .add(text("Material", "What it is made of, from the list Materials; isotropic."))
      .add(number("Outer Radius", "m", "Radius of the outer circle.").positive())
      .add(number("Wall Thickness", "m", "Thickness of the wall.").positive())
      .add(integers("Elements", "Around, for shells, and along.").at_least(1).size(2))
      .add(integer("Order", "Order of the elements of the beam.").between(1, 3).optional(2))
      .add(choice("Fidelity", {"Full", "Kirchhoff", "Linear", "Rigid"},
                  "Of the beam or the shell, see there; shells are Full or Linear.")
               .optional("Full"))
      .add(choice(
               "Ends", {"Rigid", "Soft"},
               "How the ends of the shell follow their nodes: Rigid keeps the ring as it is, Soft "
               "lets it widen and its wall stretch.")
               .optional("Rigid"))
      .check([](const Options& tube, InputIssues& issues) {
        const std::string& fidelity = tube.text("Fidelity");
        if (tube.text("Model") == "Shell" && fidelity != "Full" && fidelity != "Linear") {
          issues.add(
              tube.where("Fidelity"),
              fmt::format("'{}' is one of beams; a tube of shells is Full or Linear. What is "
                          "rigid may be a beam with Fidelity = Rigid",
                          fidelity));
        }
        if (tube.number("Wall Thickness") > tube.number("Outer Radius")) {
          issues.add(tube.where("Wall Thickness"), "must be <= the outer radius");
        }
        const Vec3 axis = model::vector(tube, "To") - model::vector(tube, "From");
        if (axis.norm() == 0.0) issues.add(tube.where("To"), "must differ from 'From'");
        if (axis.cross(model::vector(tube, "Up")).norm() <=
            1e-3 * axis.norm() * model::vector(tube, "Up").norm()) {
          issues.add(tube.where("Up"), "must not be parallel to the axis");
        }
      });
  return schema;
}

const material::Material& find_material(const Options& options,
                                        const structure::StructureContext& context) {
  const auto& materials = context.materials;
  const std::string& name = options.text("Material");
  if (const auto found = materials.find(name); found != materials.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, material] : materials) names.push_back(known);
  throw InputError(options.where("Material"),
                   fmt::format("unknown material '{}'{}", name, did_you_mean(name, names)));
}

struct Moduli {
  double young;    // [N/m^2]
  double poisson;  // [-]
};

// λ and μ stand in the stiffness of an isotropic solid, and nothing else does.
Moduli isotropic_moduli(const material::Material& material, const Options& options) {
  const Mat6& C = material::small_strain_stiffness(material.law);
  const double lambda = C(0, 1);
  const double mu = C(5, 5);
  const Vec3& expansion = material.expansion;
  const bool grows_alike = expansion == Vec3::Constant(expansion[0]);
  if ((C - material::lame_stiffness(lambda, mu)).norm() > 1e-9 * C.norm() || !grows_alike) {
    throw InputError(options.where("Material"),
                     fmt::format("'{}' is not isotropic", options.text("Material")));
  }
  return {mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu), lambda / (2.0 * (lambda + mu))};
}

material::Section tube_section(const Options& options, const material::Material& material) {
  const Moduli moduli = isotropic_moduli(material, options);
  const material::Profile profile = material::TubeSection::profile(
      options.number("Outer Radius"), options.number("Wall Thickness"), moduli.poisson);
  const double G = moduli.young / (2.0 * (1.0 + moduli.poisson));
  const double rho = material.density;
  material::Section section;
  section.stiffness = material::stiffness_matrix({.EA = moduli.young * profile.area,
                                                  .GA1 = profile.k1 * G * profile.area,
                                                  .GA2 = profile.k2 * G * profile.area,
                                                  .EI1 = moduli.young * profile.I1,
                                                  .EI2 = moduli.young * profile.I2,
                                                  .GIp = G * profile.torsion});
  section.mass = material::mass_matrix(
      {.rhoA = rho * profile.area, .rhoI1 = rho * profile.I1, .rhoI2 = rho * profile.I2});
  section.outline = profile.outline;
  section.expansion = material.expansion[0];
  return section;
}

void add_as_beam(const Options& tube, structure::StructureContext& context) {
  const material::Material& material = find_material(tube, context);
  const std::string name = "tube";
  const Schema schema = beam::beam_schema();
  Options list = default_list(schema, tube.name(), tube.where());
  list.set("Section", name)
      .set("Order", tube.integer("Order"))
      .set("Fidelity", tube.text("Fidelity"))
      .set("Dissipation", material.dissipation)
      .set("Damping", material.damping);
  const std::string line = "Line";
  Options curve = default_list(*schema.find_slot("Curve")->find(line), "Curve", tube.where());
  curve.set("Type", line)
      .set("From", tube.numbers("From"))
      .set("To", tube.numbers("To"))
      .set("Up", tube.numbers("Up"))
      .set("Elements", tube.integers("Elements")[1]);
  list.add_list(std::move(curve));
  const std::map<std::string, material::Section> sections{{name, tube_section(tube, material)}};
  structure::StructureContext beams{context.model,        sections,      context.materials,
                                    context.issues,       context.log,   context.refinement,
                                    context.imperfection, context.budget};
  beam::add_beam(list, beams);
}

// A node at an end of the shell, which the ring of nodes there follows.
void add_end(const Options& tube, const char* end, const char* edge, const Mat3& triad,
             structure::StructureContext& context) {
  model::Model& model = context.model;
  const std::string name = tube.name() + " " + end;
  const std::vector<int> ring = model.find_structure(tube.name())->sets.at(edge);
  model::NodeSlots slots;
  slots << model::vector(tube, std::string(end) == "first" ? "From" : "To"), triad;
  if (context.imperfection != nullptr) slots = context.imperfection->moved(name, slots);
  const int node = model.nodes().add(slots);
  model::Structure& structure = model.add_structure(name);
  structure.nodes = {node};
  structure.sets = {{"first", {node}}, {"last", {node}}, {"all", {node}}};
  structure.cells.push_back({{node}, nullptr, 0});
  model.add_node_set(tube.name() + "/" + end, {node});
  for (int follower : ring) {
    if (tube.text("Ends") == "Rigid") {
      model.add_rigid_link(structure.name, follower, node);
    } else {
      model::Constraint joint = joint::soft_transition(model.nodes(), follower, node);
      joint.name = structure.name;
      joint.type = "Soft Transition";
      joint.is_structural = true;
      joint.where = tube.where();
      model.add_constraint(std::move(joint));
    }
  }
}

void add_as_shell(const Options& tube, structure::StructureContext& context) {
  const Schema schema = shell::shell_schema();
  const Vec3 from = model::vector(tube, "From");
  const Vec3 axis = model::vector(tube, "To") - from;
  const Mat3 triad = triad_along(axis, model::vector(tube, "Up"));
  const double wall = tube.number("Wall Thickness");
  isotropic_moduli(find_material(tube, context), tube);
  Options list = default_list(schema, tube.name(), tube.where());
  list.set("Material", tube.text("Material"))
      .set("Thickness", wall)
      .set("Fidelity", tube.text("Fidelity"))
      .set("Reference Axis", numbers_of(axis));
  const std::string cylinder = "Cylinder";
  Options mesh = default_list(*schema.find_slot("Mesh")->find(cylinder), "Mesh", tube.where());
  mesh.set("Type", cylinder)
      .set("Radius", tube.number("Outer Radius") - 0.5 * wall)
      .set("Length", axis.norm())
      .set("Elements", tube.integers("Elements"))
      .set("Origin", tube.numbers("From"))
      .set("Rotation", numbers_of(log_rotation(triad)));
  list.add_list(std::move(mesh));
  shell::add_shell(list, context);
  add_end(tube, "first", "v0", triad, context);
  add_end(tube, "last", "v1", triad, context);
}

void add_tube(const Options& tube, structure::StructureContext& context) {
  if (tube.text("Model") == "Beam") {
    add_as_beam(tube, context);
  } else {
    add_as_shell(tube, context);
  }
}

}  // namespace

void register_hybrids(structure::StructureRegistry& registry) {
  registry.add("Tube", tube_schema(), add_tube);
}

}  // namespace culm::hybrid
