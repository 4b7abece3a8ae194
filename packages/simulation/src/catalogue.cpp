#include <culm/beam/register_beam.hpp>
#include <culm/body/register_body.hpp>
#include <culm/contact/register_contact.hpp>
#include <culm/heat/register_heat.hpp>
#include <culm/hybrid/tube.hpp>
#include <culm/joint/register_joint.hpp>
#include <culm/lattice/register_lattice.hpp>
#include <culm/load/register_load.hpp>
#include <culm/model/initial_motion.hpp>
#include <culm/output/file_part.hpp>
#include <culm/rotor/register_rotor.hpp>
#include <culm/shell/shell_structure.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/soil/register_soil.hpp>
#include <culm/water/register_water.hpp>

#include "acceleration_quantity.hpp"
#include "contact_quantity.hpp"
#include "earlier_states.hpp"
#include "fluid_quantities.hpp"
#include "imperfections.hpp"
#include "line_quantity.hpp"
#include "mpi_partner.hpp"
#include "sampled_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace culm::simulation {

Catalogue::Catalogue() {
  material::register_sections(sections);
  material::register_materials(materials);
  beam::register_beams(structures);
  shell::register_shells(structures);
  hybrid::register_hybrids(structures);
  body::register_bodies(structures);
  body::register_masses(masses);
  model::register_initial_motions(initial_conditions);
  model::register_amplitudes(functions);
  model::register_vector_fields(fields);
  control::register_signals(signals);
  register_sampled_signal(signals);
  joint::register_joints(constraints);
  load::register_loads(loads);
  heat::register_heat(loads);
  contact::register_contact(loads);
  soil::register_soil(loads);
  flow::register_flows(flows);
  water::register_seas(flows);
  strip::register_airfoils(airfoils);
  strip::register_strips(strips);
  rotor::register_rotors(strips);
  lattice::register_lattice(fluid_loads);
  water::register_water_loads(fluid_loads);
  port::register_ports(ports);
  coupling::register_partners(partners);
  register_mpi_partner(partners);
  analysis::register_analyses(analyses);
  register_node_quantities(quantities);
  register_acceleration_quantity(quantities);
  register_signal_quantity(quantities);
  register_link_quantities(quantities);
  register_line_quantity(quantities);
  register_contact_quantity(quantities);
  register_fluid_quantities(quantities);
  register_element_quantities(quantities);
  register_section_loads(quantities);
  register_distance_quantity(quantities);
}

namespace {

Schema solver_schema() {
  return Schema("Solver", "Form of the equations and solution of linear systems.")
      .add(choice("Form", {"Null Space", "Multipliers"},
                  "Six unknowns per node, or the twelve director coordinates with all constraints "
                  "as equations: the reference to compare with.")
               .optional("Null Space"))
      .add(
          choice("Linear Solver", solver::linear_solver_names(),
                 "Solver of the linear systems: Block LU is best for beams, MUMPS for shells, KLU2 "
                 "needs no blocks; Iterative (multigrid) is for shells whose factors do not fit "
                 "into the memory. 'Automatic' decides by the predicted fill of the factors and "
                 "says so.")
              .optional(solver::linear_solver_names().front()));
}

Schema node_sets_schema() {
  Schema set("Node Set", "Nodes under one name.");
  set.add(texts("Nodes", "Nodes, each as 'structure/number', 'structure/set' or 'structure'.")
              .min_size(1));
  return Schema("Node Sets",
                "Node sets by name; where a node is asked for, the name stands for "
                "all of them.")
      .entries(std::move(set));
}

Schema element_sets_schema() {
  Schema set("Element Set", "Elements of one structure under one name.");
  set.add(model::structure_field())
      .add(integers("Elements", "Numbers of the elements in the structure, from 0.")
               .at_least(0)
               .min_size(1)
               .optional())
      .add(integers("Range", "First and last element of a run of elements, instead.")
               .at_least(0)
               .size(2)
               .optional())
      .check([](const Options& options, InputIssues& issues) {
        if (options.has("Elements") == options.has("Range")) {
          issues.add(options.where(), "needs either 'Elements' or 'Range'");
        }
        if (!options.has("Elements")) return;
        std::vector<int> elements = options.integers("Elements");
        std::ranges::sort(elements);
        const auto twice = std::ranges::adjacent_find(elements);
        if (twice != elements.end()) {
          issues.add(options.where("Elements"),
                     fmt::format("names element {} more than once", *twice));
        }
      });
  return Schema("Element Sets",
                "Element sets by name; where loads per length ask for a structure, the name stands "
                "for its elements.")
      .entries(std::move(set));
}

Schema output_schema(const QuantityRegistry& quantities) {
  return Schema("Output", "What is written.")
      .add(integer("Every", "Steps from one recorded state to the next.").at_least(1).optional(1))
      .add(flag("Pictures", "Write VTU files beside run.h5.").optional(true))
      .add(integer("Most Pictures",
                   "Of the recorded states of an analysis, beside the last one: if there are more, "
                   "every "
                   "second, fourth, … has VTU files. All are in run.h5.")
               .at_least(2)
               .optional(100))
      .add(flag("Velocities",
                "Record velocities of nodes, and angular velocities of those with directors, with "
                "each state.")
               .optional(false))
      .add(flag("Constraint Forces",
                "Record with each step what supports, joints and drives exert on their nodes.")
               .optional(false))
      .add(flag("Checkpoints", "Write checkpoints, from which 'culm resume' goes on.")
               .optional(true))
      .add(number("Checkpoint Interval", "s",
                  "Time on the clock from one checkpoint to the next; one at the end is always "
                  "written. Writing takes at most a hundredth of the time.")
               .at_least(0.0)
               .optional(300.0))
      .list("Shell",
            Schema("Shell",
                   "What is shown of the layers of shells beside stress resultants, at the centre "
                   "of each element, at bottom, middle and top of each layer, in its axes.")
                .add(flag("Stresses", "Second Piola-Kirchhoff stresses.").optional(false))
                .add(flag("Strains", "Green-Lagrange strains, shears in full.").optional(false))
                .add(integers("Layers", "Numbers of the layers, the bottom one 0; all if absent.")
                         .at_least(0)
                         .min_size(1)
                         .optional()),
            Presence::defaulted)
      .list("History",
            Schema("History", "Quantities of each step, in history.csv and run.h5.")
                .entries_by_type(quantities.variants()),
            Presence::defaulted);
}

}  // namespace

namespace {

// What every analysis has.
Variants with_common_fields(Variants analyses) {
  for (auto& [type, schema] : analyses) {
    schema
        .add(text("Start From",
                  "Where it starts: the name of an earlier analysis, 'Reference', or the results "
                  "folder, run.h5 or checkpoint of another run with the same structures; the last "
                  "state if "
                  "absent.")
                 .optional())
        .add(texts("Inactive",
                   "Loads, constraints and imperfections that do not act in it, by name.")
                 .optional(std::vector<std::string>{}));
  }
  return analyses;
}

// What every load has.
Variants with_account(Variants loads) {
  for (auto& [type, schema] : loads) {
    schema.add(
        text(
            "Account",
            "Line of the balance of energy in which its work is shown; loads of one account "
            "are summed. If absent: air, water, contact, heat and soil that slides have their own, "
            "others none.")
            .optional());
  }
  return loads;
}

// Functions that every deck has.
void check_functions(const Options& list, InputIssues& issues) {
  for (const Options& entry : list.entries()) {
    if (entry.name() == "Ramp" || entry.name() == "Constant") {
      issues.add(entry.where(), "is the name of a function that every deck has; take another one");
    }
  }
}

// Names that become those of files or folders, in which capitals and special characters do not
// count. @param what  "the folder 'analyses/{}'"
void refuse_shared_files(const Options& list, fmt::string_view what, InputIssues& issues) {
  constexpr std::size_t longest = 200;  // file systems take 255, with what stands before and after
  std::map<std::string, std::string> files;
  for (const Options& entry : list.entries()) {
    const auto [first, is_new] = files.emplace(output::file_part(entry.name()), entry.name());
    if (first->first.size() > longest) {
      issues.add(entry.where(), fmt::format("is part of the name of a file, which may have {} "
                                            "bytes of it, and has {}",
                                            longest, first->first.size()));
    }
    if (is_new) continue;
    issues.add(entry.where(), "would share " + fmt::format(fmt::runtime(what), first->first) +
                                  " with '" + first->second + "'; take another name");
  }
}

void check_analyses(const Options& list, InputIssues& issues) {
  for (const Options& entry : list.entries()) {
    if (entry.name() == EarlierStates::reference) {
      issues.add(entry.where(), "is the name of the state at the beginning; take another one");
    }
  }
  refuse_shared_files(list, "the folder 'analyses/{}'", issues);
}

void check_ports(const Options& list, InputIssues& issues) {
  refuse_shared_files(list, "the picture 'port_{}.vtu'", issues);
}

void check_partners(const Options& deck, InputIssues& issues) {
  if (!deck.has_list("Coupling")) return;
  refuse_shared_files(deck.list("Coupling").list("Partners"), "the record 'coupling_{}.record'",
                      issues);
}

Schema::Check at_least_one(std::string what) {
  return [what = std::move(what)](const Options& list, InputIssues& issues) {
    if (list.entries().empty()) issues.add(list.where(), "must hold at least one " + what);
  };
}

}  // namespace

Schema Catalogue::deck_schema() const {
  Variants all_loads = loads.variants();
  all_loads.merge(fluid_loads.variants());
  all_loads.merge(strips.variants());
  return Schema("culm", "An input deck.")
      .add(text("Title", "What the deck shows.").optional(""))
      .add(integer("Refinement",
                   "Elements for each one that the deck asks for, along each of its directions. "
                   "Numbers of nodes and elements in the deck keep their meaning.")
               .between(1, 1024)
               .optional(1))
      .list("Sections",
            Schema("Sections", "Cross-sections by name.").entries_by_type(sections.variants()),
            Presence::defaulted)
      .list("Materials",
            Schema("Materials", "What shells are made of, by name.")
                .entries_by_type(materials.variants()),
            Presence::defaulted)
      .list("Structures", Schema("Structures", "Parts of the model by name.")
                              .entries_by_type(structures.variants())
                              .check(at_least_one("structure")))
      .list("Imperfections", imperfections_schema(), Presence::defaulted)
      .list("Masses",
            Schema("Masses", "Masses on nodes by name.").entries_by_type(masses.variants()),
            Presence::defaulted)
      .list("Node Sets", node_sets_schema(), Presence::defaulted)
      .list("Element Sets", element_sets_schema(), Presence::defaulted)
      .list("Functions",
            Schema("Functions", "Functions of time by name; 'Ramp' and 'Constant' are there.")
                .entries_by_type(functions.variants())
                .check(check_functions),
            Presence::defaulted)
      .list(
          "Fields",
          Schema("Fields", "Vectors in space and time by name.").entries_by_type(fields.variants()),
          Presence::defaulted)
      .list("Signals",
            Schema(
                "Signals",
                "Measured quantities and blocks of controls by name, which loads, drives and other "
                "signals follow as they follow functions.")
                .entries_by_type(signals.variants()),
            Presence::defaulted)
      .list("Constraints",
            Schema("Constraints", "Supports and joints by name.")
                .entries_by_type(constraints.variants()),
            Presence::defaulted)
      .list("Flows",
            Schema("Flows", "Media by name that structures stand or move in.")
                .entries_by_type(flows.variants()),
            Presence::defaulted)
      .list("Airfoils",
            Schema("Airfoils", "What sections do in a flow, by name.")
                .entries_by_type(airfoils.variants()),
            Presence::defaulted)
      .list("Loads",
            Schema("Loads", "Loads by name.").entries_by_type(with_account(std::move(all_loads))),
            Presence::defaulted)
      .list("Ports",
            Schema("Ports",
                   "Points by name at which another program sees motion and sets forces and "
                   "moments from step to step.")
                .entries_by_type(ports.variants())
                .check(check_ports),
            Presence::defaulted)
      .list("Coupling", coupling::coupling_schema(partners), Presence::optional)
      .list("Initial Conditions",
            Schema("Initial Conditions", "How the model moves at the start, by name.")
                .entries_by_type(initial_conditions.variants()),
            Presence::defaulted)
      .list("Solver", solver_schema(), Presence::defaulted)
      .list("Analyses",
            Schema("Analyses", "What is done, in this order; each starts from the last state.")
                .entries_by_type(with_common_fields(analyses.variants()))
                .check(at_least_one("analysis"))
                .check(check_analyses))
      .list("Output", output_schema(quantities), Presence::defaulted)
      .check(check_partners);
}

}  // namespace culm::simulation
