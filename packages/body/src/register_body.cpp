#include <culm/body/inertia.hpp>
#include <culm/body/register_body.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/one_director.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace culm::body {
namespace {

Schema body_schema(const std::string& type, const std::string& doc) {
  return Schema(type, doc)
      .add(model::vector_field("Position", "m", "Position of the node in the reference."))
      .add(numbers("Directors", "1", "d1, d2, d3 in the reference; orthonormal, right-handed.")
               .size(9)
               .optional({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}));
}

Field density_field() { return number("Density", "kg/m^3", "Mass per volume.").positive(); }
Field radius_field() { return number("Radius", "m", "Radius of the circle.").positive(); }
Field height_field() { return number("Height", "m", "Extent along d3.").positive(); }

// Adds a structure of one node with mass.
void build(const Options& options, const Inertia& inertia, structure::StructureContext& context) {
  if (context.budget != nullptr) {
    constexpr double nodes = 2.0;  // a body takes 13 kB, as two nodes of a beam do
    context.budget->take_beam(1.0, nodes, options.where());
  }
  const Mat3 triad = Eigen::Map<const Mat3>(options.numbers("Directors").data());
  if (triad_defect(triad) > 1e-6) {
    context.issues.add(options.where("Directors"),
                       "must be orthonormal and right-handed to within 1e-6");
  }
  for (const std::string& mistake : mistakes(inertia)) {
    context.issues.add(options.where(), mistake);
  }
  model::NodeSlots slots;
  slots << model::vector(options, "Position"), nearest_rotation(triad);
  model::Model& model = context.model;
  if (context.imperfection != nullptr) {
    slots = context.imperfection->moved(options.name(), slots);
  }
  const int node = model.nodes().add(slots);
  model::Structure& structure = model.add_structure(options.name());
  structure.nodes = {node};
  structure.sets = {{"first", {node}}, {"last", {node}}, {"all", {node}}};
  structure.cells.push_back({{node}, nullptr, 0});
  model.masses("Rigid bodies").add(node, mass_matrix(inertia));
}

void add_shape(structure::StructureRegistry& registry, Schema schema,
               std::function<Inertia(const Options&)> inertia) {
  const std::string type = schema.name();
  registry.add(type, std::move(schema),
               [inertia](const Options& options, structure::StructureContext& context) {
                 build(options, inertia(options), context);
               });
}

Inertia read_inertia(const Options& options) {
  const std::vector<double>& t = options.numbers("Inertia");
  Inertia inertia{options.number("Mass"), model::vector(options, "Centre"), Mat3::Zero()};
  inertia.tensor.diagonal() << t[0], t[1], t[2];
  if (t.size() == 6) {
    inertia.tensor(1, 2) = inertia.tensor(2, 1) = t[3];
    inertia.tensor(0, 2) = inertia.tensor(2, 0) = t[4];
    inertia.tensor(0, 1) = inertia.tensor(1, 0) = t[5];
  }
  return inertia;
}

void build_point_mass(const Options& options, model::BuildContext& context) {
  const Vec3 offset = model::vector(options, "Offset");
  const std::vector<int> nodes = model::select_loaded_nodes(options, "Node", context);
  model::check_components("Offset", nodes, options, context);
  for (int node : nodes) {
    const Inertia point{options.number("Mass"), offset, Mat3::Zero()};
    context.model.masses("Point masses").add(node, mass_matrix(point));
  }
}

}  // namespace

void register_bodies(structure::StructureRegistry& registry) {
  Schema by_numbers = body_schema("Rigid Body", "Rigid body by its mass properties.");
  by_numbers.add(number("Mass", "kg", "Mass.").positive())
      .add(model::vector_field("Centre", "m", "Centre of mass from the node, in its directors.")
               .optional({0.0, 0.0, 0.0}))
      .add(numbers("Inertia", "kg m^2",
                   "Inertia tensor about the centre of mass in the directors: 11, 22, 33, or 11, "
                   "22, 33, 23, 13, 12.")
               .size_multiple_of(3)
               .min_size(3))
      .check([](const Options& options, InputIssues& issues) {
        if (options.numbers("Inertia").size() > 6) {
          issues.add(options.where("Inertia"), "must have 3 or 6 items");
        }
      });
  add_shape(registry, by_numbers, read_inertia);
  add_shape(
      registry,
      body_schema("Rigid Box", "Solid box about its centre.")
          .add(model::vector_field("Size", "m", "Sides along d1, d2, d3.").positive())
          .add(density_field()),
      [](const Options& o) { return solid_box(model::vector(o, "Size"), o.number("Density")); });
  add_shape(registry,
            body_schema("Rigid Cylinder", "Solid cylinder about its centre, axis d3.")
                .add(radius_field())
                .add(height_field())
                .add(density_field()),
            [](const Options& o) {
              return solid_cylinder(o.number("Radius"), o.number("Height"), o.number("Density"));
            });
  add_shape(registry,
            body_schema("Rigid Sphere", "Solid sphere about its centre.")
                .add(radius_field())
                .add(density_field()),
            [](const Options& o) { return solid_sphere(o.number("Radius"), o.number("Density")); });
  add_shape(registry,
            body_schema("Rigid Cone", "Solid cone about the centre of its base, apex along d3.")
                .add(radius_field())
                .add(height_field())
                .add(density_field()),
            [](const Options& o) {
              return solid_cone(o.number("Radius"), o.number("Height"), o.number("Density"));
            });
}

void register_masses(model::BuilderRegistry& registry) {
  registry.add("Point Mass",
               Schema("Point Mass", "Mass at a point fixed to a node.")
                   .add(model::node_field())
                   .add(number("Mass", "kg", "Mass.").positive())
                   .add(model::vector_field("Offset", "m", "From the node, in its directors.")
                            .optional({0.0, 0.0, 0.0})),
               build_point_mass);
}

}  // namespace culm::body
