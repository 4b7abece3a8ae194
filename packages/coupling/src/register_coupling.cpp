#include <culm/coupling/channel.hpp>
#include <culm/coupling/channel_flow.hpp>
#include <culm/coupling/point_partner.hpp>
#include <culm/coupling/pressure_partner.hpp>
#include <culm/coupling/register_coupling.hpp>
#include <culm/coupling/remote_partner.hpp>
#include <culm/coupling/replay.hpp>
#include <culm/coupling/scheme.hpp>
#include <culm/coupling/test_partners.hpp>
#include <culm/joint/marker_pair.hpp>
#include <culm/model/vector_field.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace culm::coupling {
namespace {

Schema partner(std::string type, std::string doc) {
  return Schema(std::move(type), std::move(doc))
      .add(text("Port", "Where it acts; the only port of the deck if absent.").optional());
}

// A model that may make steps of its own.
void add_stepping_partner(PartnerRegistry& registry, const std::string& type, Schema schema,
                          const std::function<std::unique_ptr<PointModel>(const Options&)>& make) {
  schema
      .add(integer("Steps", "Steps that it makes in each window, its points moving straight.")
               .between(1, 1000000)
               .optional(1))
      .add(choice("Window Load", {"Mean", "Last"},
                  "What it answers: the mean of its steps, which keeps the energy, or the forces "
                  "of the last one, which do not.")
               .optional("Mean"));
  registry.add(type, std::move(schema), [make](const Options& options) {
    const auto load = options.text("Window Load") == "Mean" ? WindowLoad::mean : WindowLoad::last;
    return std::make_unique<PointPartner>(make(options), options.integer("Steps"), load);
  });
}

std::vector<port::Face> read_faces(const std::vector<int>& triangles,
                                   const std::vector<int>& quadrilaterals) {
  std::vector<port::Face> faces;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    faces.push_back({triangles[i], triangles[i + 1], triangles[i + 2], -1});
  }
  for (std::size_t i = 0; i + 3 < quadrilaterals.size(); i += 4) {
    faces.push_back(
        {quadrilaterals[i], quadrilaterals[i + 1], quadrilaterals[i + 2], quadrilaterals[i + 3]});
  }
  return faces;
}

Schema channel_schema() {
  Schema schema =
      partner("Channel",
              "An ideal fluid in a channel under a wall: points at equal distances in a "
              "row, the first and the last one a distance away from its open ends.");
  schema.add(number("Density", "kg/m^3", "Of the fluid.").positive())
      .add(number("Height", "m", "Of the fluid, from the wall to a floor.").positive())
      .add(number("Width", "m", "Across.").positive().optional(1.0));
  joint::add_direction("Normal", "Of the wall, of any length; it moves along it.", schema);
  return schema;
}

// As the deck names them.
const std::vector<std::pair<std::string, Fault>>& faults() {
  static const std::vector<std::pair<std::string, Fault>> all = {
      {"Death", Fault::death},
      {"No Number", Fault::no_number},
      {"Infinite", Fault::infinite},
      {"Wrong Count", Fault::wrong_count},
      {"Scaled", Fault::scaled},
      {"Turned", Fault::turned},
      {"Old", Fault::old},
      {"Wrong Energy", Fault::wrong_energy},
      {"Infinite Energy", Fault::infinite_energy},
      {"Lost Books", Fault::lost_books},
      {"Slow", Fault::slow}};
  return all;
}

Schema faulty_schema() {
  std::vector<std::string> names;
  for (const auto& [name, fault] : faults()) names.push_back(name);
  return partner("Faulty", "A mass at each point that fails, to see what becomes of a run then.")
      .add(choice("Fault", names,
                  "Scaled answers half of the right forces, Turned the opposite, Old those of the "
                  "last window that was right; Slow is a tenth of a second late.")
               .optional("Death"))
      .add(number("Mass", "kg", "At each point.").at_least(0.0).optional(0.0))
      .add(integer("Window", "From which window on, the first one 0.").at_least(0));
}

std::unique_ptr<Partner> make_faulty(const Options& o) {
  const auto named = std::find_if(faults().begin(), faults().end(),
                                  [&](const auto& one) { return one.first == o.text("Fault"); });
  return std::make_unique<FaultyPartner>(named->second, o.integer("Window"), o.number("Mass"));
}

Schema socket_schema() {
  Schema schema =
      partner("Socket", "Another program, which comes to an address and speaks the wire format.");
  schema
      .add(text("Address",
                "'unix:PATH', 'tcp:PORT' for programs on this machine, or 'tcp:ADDRESS:PORT'."))
      .check([](const Options& o, InputIssues& issues) {
        const std::string objection = objection_to_address(o.text("Address"));
        if (!objection.empty()) issues.add(o.where("Address"), objection);
      });
  add_patience_fields(schema);
  return schema;
}

Field mass_field() { return number("Mass", "kg", "At each point.").positive(); }

}  // namespace

void register_partners(PartnerRegistry& registry) {
  // steps of its own would see no acceleration where points move straight
  registry.add(
      "Added Mass",
      partner("Added Mass", "A mass at each point: water round a mast acts so.").add(mass_field()),
      [](const Options& o) {
        return std::make_unique<PointPartner>(make_added_mass(o.number("Mass")), 1,
                                              WindowLoad::mean);
      });
  registry.add("Channel", channel_schema(), [](const Options& o) {
    return std::make_unique<PointPartner>(
        make_channel_flow({o.number("Density"), o.number("Height"), o.number("Width"),
                           model::vector(o, "Normal").normalized()}),
        1, WindowLoad::mean);
  });
  add_stepping_partner(registry, "Dashpot",
                       partner("Dashpot", "A dashpot from each point to the ground.")
                           .add(number("Damping", "N s/m", "Of each.").positive()),
                       [](const Options& o) { return make_dashpot(o.number("Damping")); });
  add_stepping_partner(
      registry, "Oscillator",
      partner("Oscillator", "A mass that hangs on each point by a spring.")
          .add(mass_field())
          .add(number("Stiffness", "N/m", "Of each spring.").positive()),
      [](const Options& o) { return make_oscillator(o.number("Mass"), o.number("Stiffness")); });
  registry.add(
      "Random",
      partner("Random", "Forces at random, others in each window, to see what a model endures.")
          .add(number("Force", "N", "The largest in each direction, at each point.").positive())
          .add(integer("Seed", "Another one, other forces.").at_least(0).optional(0)),
      [](const Options& o) {
        return std::make_unique<RandomPartner>(o.number("Force"),
                                               static_cast<std::uint64_t>(o.integer("Seed")));
      });
  registry.add(
      "Pressure",
      partner("Pressure", "A constant pressure on a surface between the points of its port.")
          .add(number("Pressure", "Pa", "On the outside; below zero: it pushes outwards."))
          .add(integers("Triangles",
                        "Numbers of points in the port, three for each face, anticlockwise seen "
                        "from outside.")
                   .at_least(0)
                   .size_multiple_of(3)
                   .optional(std::vector<int>{}))
          .add(integers("Quadrilaterals", "The same for faces of four points.")
                   .at_least(0)
                   .size_multiple_of(4)
                   .optional(std::vector<int>{})),
      [](const Options& o) {
        return std::make_unique<PressurePartner>(
            o.number("Pressure"),
            read_faces(o.integers("Triangles"), o.integers("Quadrilaterals")));
      });
  registry.add("Faulty", faulty_schema(), make_faulty);
  registry.add(
      "Recorded",
      partner("Recorded",
              "The loads of a record, whatever the structure does; how it moves is "
              "compared.")
          .add(text("File Name", "What a coupling with 'Record' wrote, relative to the deck.")),
      [](const Options& o) {
        const std::filesystem::path deck = o.where("File Name").file;
        const std::filesystem::path file = deck.parent_path() / o.text("File Name");
        return std::make_unique<ReplayedPartner>(read_record(file), file.string());
      });
  registry.add("Socket", socket_schema(), [](const Options& o) {
    const double patience = o.number("Patience");
    return make_remote_partner(
        o, [address = o.text("Address"), patience] { return listen(address, patience); });
  });
}

namespace {

// Where a partner is met; empty for one in process.
std::string place_of(const Options& partner) {
  const std::string& type = partner.text("Type");
  if (type == "MPI") return "rank " + std::to_string(partner.integer("Rank"));
  return type == "Socket" ? "'" + complete_address(partner.text("Address")) + "'" : std::string();
}

void refuse_one_place_for_two(const Options& coupling, InputIssues& issues) {
  std::map<std::string, std::string> first;
  for (const Options& partner : coupling.list("Partners").entries()) {
    const std::string place = place_of(partner);
    if (place.empty()) continue;
    const auto [other, is_new] = first.emplace(place, partner.name());
    if (is_new) continue;
    issues.add(partner.where(partner.text("Type") == "MPI" ? "Rank" : "Address"),
               "partner '" + other->second + "' comes to " + place + " already");
  }
}

}  // namespace

Schema coupling_schema(const PartnerRegistry& partners) {
  Schema schema("Coupling",
                "Partners that answer the motion of ports with loads, in all analyses of type "
                "'Dynamic'.");
  add_scheme_fields(schema);
  return schema
      .add(number("Tolerance", "1",
                  "Difference of loads and answer, over the answer, at which a window is repeated "
                  "no more.")
               .positive()
               .optional(1e-8))
      .add(integer("Most Attempts", "Per window.").at_least(1).optional(100))
      .add(number("Window", "s",
                  "From exchange to exchange: the structure makes steps of its own in it, under "
                  "constant loads. Each step is a window if absent.")
               .positive()
               .optional())
      .add(flag("Record", "Write all that is said into 'coupling_NAME.record'.").optional(false))
      .list("Partners",
            Schema("Partners", "Who answers, by name.").entries_by_type(partners.variants()))
      .check(refuse_one_place_for_two);
}

}  // namespace culm::coupling
