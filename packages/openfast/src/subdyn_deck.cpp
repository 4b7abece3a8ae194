#include "subdyn_deck.hpp"

#include <culm/base/error.hpp>
#include <culm/openfast/deck_writer.hpp>

#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace culm::openfast {

namespace {

constexpr double gravity = 9.80665;

std::string name_of(const SubMember& member) { return fmt::format("member {}", member.id); }
std::string name_of(const SubSection& section) {
  return fmt::format("{} {}", section.is_tube ? "tube" : "section", section.id);
}
std::string body_at(const SubDyn& sub, std::size_t joint) {
  return fmt::format("joint {}", sub.joints[joint].id);
}

// Of a circular hollow section. @source Steinboeck, Kooi, Hoogstraten (2013), as SubDyn
double shear_factor(const SubSection& tube) {
  const double nu = 0.5 * tube.young / tube.shear - 1.0;
  const double ratio = (tube.diameter - 2.0 * tube.wall) / tube.diameter;
  const double m = ratio * ratio, square = (1.0 + m) * (1.0 + m);
  return 6.0 * (1.0 + nu) * (1.0 + nu) * square /
         (square * (7.0 + 14.0 * nu + 8.0 * nu * nu) + 4.0 * m * (5.0 + 10.0 * nu + 4.0 * nu * nu));
}

class SubDeck {
 public:
  SubDeck(const SubDyn& sub, DeckWriter& deck, Report& report)
      : sub_(sub), report_(report), deck_(deck), ends_(sub.joints.size()) {
    find_ends();
  }

  const std::string& node_at(std::size_t joint) const { return ends_[joint].front(); }

  void write_sections() {
    for (const SubSection& section : sub_.sections) {
      if (section.is_tube) {
        write_tube(section);
      } else {
        write_arbitrary(section);
      }
    }
  }

  void write_structures() {
    for (const SubMember& member : sub_.members) {
      if (member.kind == SubMember::Kind::beam) write_beam(member);
    }
    for (std::size_t i = 0; i < sub_.masses.size(); ++i) write_body(i);
  }

  void write_masses() {
    for (std::size_t i = 0; i < sub_.masses.size(); ++i) {
      const std::string name = fmt::format("mass {}", i + 1);
      const SubMass& mass = sub_.masses[i];
      if (!is_point(mass) || node_at(mass.joint) == name || mass.mass == 0.0) continue;
      deck_.open(name, "Point Mass");
      deck_.set("Node", node_at(mass.joint));
      deck_.set("Mass", mass.mass);
      deck_.close();
    }
  }

  void write_constraints() {
    for (std::size_t joint = 0; joint < ends_.size(); ++joint) write_joint(joint);
    write_rigid_links();
    write_interface();
    for (const SubSupport& support : sub_.supports) {
      if (!is_place(support.joint)) write_support(support);
    }
  }

  void write_ground() {
    for (const SubSupport& support : sub_.supports) {
      if (!support.is_soft() || is_place(support.joint)) continue;
      deck_.open(body_at(sub_, support.joint) + ", ground", "Restoring");
      deck_.set("Node", node_at(support.joint));
      deck_.set_triangle("Stiffness", support.stiffness);
      deck_.close();
    }
  }

  // A cable is a spring whose free length gives it its tension.
  void write_cables() {
    for (const SubMember& member : sub_.members) {
      if (member.kind != SubMember::Kind::cable) continue;
      const SubLink& cable = sub_.cables[member.properties[0]];
      const double free = length_of(sub_, member) / (1.0 + cable.tension / cable.stiffness);
      write_cable_ends(member);
      deck_.set("Stiffness", cable.stiffness / free);
      deck_.set("Free Length", free);
      deck_.close();
      report_.add(assumed, fmt::format("{}: a cable becomes a spring of {:g} N/m with {:g} N; it "
                                       "also resists pressure, and its mass of {:g} kg is not in "
                                       "the deck",
                                       name_of(member), cable.stiffness / free, cable.tension,
                                       mass_of(sub_, member)));
    }
  }

  void write_history() {
    const auto show = [&](const std::string& name, const char* type, std::size_t joint) {
      deck_.open(name, type);
      deck_.set("Node", node_at(joint));
      deck_.close();
    };
    if (!sub_.interface.empty()) show("interface", "Displacement", sub_.interface.front());
    for (const SubSupport& support : sub_.supports) {
      const bool holds =
          std::find(support.held.begin(), support.held.end(), true) != support.held.end();
      if (is_place(support.joint)) continue;
      show(body_at(sub_, support.joint), holds ? "Reaction" : "Displacement", support.joint);
    }
    if (sub_.interface.empty() && sub_.supports.empty()) show("first joint", "Displacement", 0);
  }

  bool is_held() const {
    std::array<bool, 6> held{};
    for (const SubSupport& support : sub_.supports) {
      for (std::size_t k = 0; k < 6; ++k) held[k] = held[k] || support.resists(k);
    }
    return held[0] && held[1] && held[2];
  }

  void report_masses() {
    double beams = 0.0, others = 0.0;
    Vec3 moment = Vec3::Zero();
    for (const SubMember& member : sub_.members) {
      if (member.kind != SubMember::Kind::beam) continue;
      const double mass = mass_of(sub_, member);
      const SubSection &a = sub_.sections[member.properties[0]],
                       &b = sub_.sections[member.properties[1]];
      const double ma = a.area * a.density, mb = b.area * b.density;
      const double centre = ma + mb > 0.0 ? (ma + 2.0 * mb) / (3.0 * (ma + mb)) : 0.5;
      const Vec3 &from = sub_.joints[member.joints[0]].place,
                 &to = sub_.joints[member.joints[1]].place;
      beams += mass;
      moment += mass * (from + centre * (to - from));
    }
    for (const SubMass& mass : sub_.masses) {
      others += mass.mass;
      moment += mass.mass * (sub_.joints[mass.joint].place + mass.centre);
    }
    const Vec3 centre = beams + others > 0.0 ? Vec3(moment / (beams + others)) : Vec3::Zero();
    report_.add(masses, fmt::format("beams {:.10g} kg, concentrated {:.10g} kg, centre ({:.6g}, "
                                    "{:.6g}, {:.6g}) m, by the tables",
                                    beams, others, centre.x(), centre.y(), centre.z()));
    report_.add(assumed,
                fmt::format("{} elements of order 2 for each member; properties are linear "
                            "between its two sections, where SubDyn has the mean of each "
                            "element",
                            sub_.divisions));
    for (const SubSection& section : sub_.sections) {
      if (section.is_tube) continue;
      report_.add(assumed,
                  "axis x of members with arbitrary sections is horizontal, along (y, -x) of "
                  "the member; that of space where it is vertical");
      return;
    }
  }

 private:
  // Beams first: they carry what else is at the joint.
  void find_ends() {
    for (const SubMember& member : sub_.members) {
      if (member.kind != SubMember::Kind::beam) continue;
      ends_[member.joints[0]].push_back(name_of(member) + "/first");
      ends_[member.joints[1]].push_back(name_of(member) + "/last");
    }
    for (std::size_t i = 0; i < sub_.masses.size(); ++i) {
      const std::size_t joint = sub_.masses[i].joint;
      if (!is_point(sub_.masses[i]) || ends_[joint].empty()) {
        ends_[joint].push_back(fmt::format("mass {}", i + 1));
      }
    }
    for (std::size_t joint = 0; joint < ends_.size(); ++joint) {
      if (!ends_[joint].empty() || anchors_cables(joint)) continue;
      throw InputError({sub_.path.string(), 0, body_at(sub_, joint)},
                       "no beam and no mass is there, so that nothing gives it inertia; only where "
                       "its supports hold it in all directions may cables alone end at it");
    }
  }

  // Whether a joint is nothing but a fixed place, as where cables are anchored.
  bool is_place(std::size_t joint) const { return ends_[joint].empty(); }
  bool anchors_cables(std::size_t joint) const {
    const bool is_held = std::ranges::any_of(sub_.supports, [joint](const SubSupport& support) {
      return support.joint == joint && support.held[0] && support.held[1] && support.held[2];
    });
    const bool joins_cables = std::ranges::none_of(sub_.members, [joint](const SubMember& member) {
      return member.kind != SubMember::Kind::cable && std::ranges::count(member.joints, joint) > 0;
    });
    return is_held && joins_cables && std::ranges::count(sub_.interface, joint) == 0;
  }

  void write_cable_ends(const SubMember& cable) {
    const auto [first, second] = cable.joints;
    if (!is_place(first) && !is_place(second)) {
      deck_.open(name_of(cable), "Spring");
      deck_.set("First", node_at(first));
      deck_.set("Second", node_at(second));
      return;
    }
    if (is_place(first) && is_place(second)) {
      throw InputError({sub_.path.string(), 0, name_of(cable)},
                       "a cable between two joints that are held moves nothing: leave it out");
    }
    deck_.open(name_of(cable), "Ground Spring");
    deck_.set("Node", node_at(is_place(first) ? second : first));
    deck_.set("Anchor", sub_.joints[is_place(first) ? first : second].place);
  }

  static bool is_point(const SubMass& mass) {
    return mass.inertia.isZero(0.0) && mass.centre.isZero(0.0);
  }

  void write_tube(const SubSection& tube) {
    deck_.open(name_of(tube), tube.wall < 0.5 * tube.diameter ? "Tube" : "Circle");
    deck_.set("Young Modulus", tube.young);
    deck_.set("Shear Modulus", tube.shear);
    deck_.set("Density", tube.density);
    if (tube.wall < 0.5 * tube.diameter) {
      deck_.set("Outer Radius", 0.5 * tube.diameter);
      deck_.set("Wall Thickness", tube.wall);
    } else {
      deck_.set("Radius", 0.5 * tube.diameter);
    }
    deck_.set("Shear Factor", std::vector<double>(2, shear_factor(tube)));
    deck_.close();
  }

  void write_arbitrary(const SubSection& section) {
    deck_.open(name_of(section), "Stiffness Values");
    deck_.set("EA", section.young * section.area);
    deck_.set("GA1", section.shear * section.shear_area[0]);
    deck_.set("GA2", section.shear * section.shear_area[1]);
    deck_.set("EI1", section.young * section.bending[0]);
    deck_.set("EI2", section.young * section.bending[1]);
    deck_.set("GIp", section.shear * section.twist);
    deck_.set("rhoA", section.density * section.area);
    deck_.set("rhoI1", section.density * section.bending[0]);
    deck_.set("rhoI2", section.density * section.bending[1]);
    deck_.close();
  }

  void write_beam(const SubMember& member) {
    const SubSection& first = sub_.sections[member.properties[0]];
    const SubSection& second = sub_.sections[member.properties[1]];
    deck_.open(name_of(member), "Beam");
    if (&first == &second) {
      deck_.set("Section", name_of(first));
    } else {
      deck_.set("Sections", std::vector<std::string>{name_of(first), name_of(second)});
      deck_.set("Section Positions", std::vector<double>{0.0, 1.0});
    }
    if (sub_.damping > 0.0) deck_.set("Damping", sub_.damping);
    deck_.open("Curve", "Line");
    deck_.set("From", sub_.joints[member.joints[0]].place);
    deck_.set("To", sub_.joints[member.joints[1]].place);
    deck_.set("Up", member.x);
    deck_.set("Elements", sub_.divisions);
    deck_.close();
    deck_.close();
  }

  // A mass with inertia, or beside its joint, or where no beam is.
  void write_body(std::size_t i) {
    const SubMass& mass = sub_.masses[i];
    const std::string name = fmt::format("mass {}", i + 1);
    if (is_point(mass) && node_at(mass.joint) != name) return;
    if (!(mass.mass > 0.0)) {
      throw InputError({sub_.path.string(), 0, fmt::format("concentrated mass {}", i + 1)},
                       "has inertia or stands alone, and must have a mass > 0");
    }
    if (is_point(mass)) {
      throw InputError({sub_.path.string(), 0, fmt::format("concentrated mass {}", i + 1)},
                       "stands alone and has no inertia, so that nothing resists its rotation: "
                       "give it JMXX, JMYY and JMZZ > 0, small ones if it hangs in cables only");
    }
    const Mat3& J = mass.inertia;
    deck_.open(name, "Rigid Body");
    deck_.set("Position", sub_.joints[mass.joint].place);
    deck_.set("Mass", mass.mass);
    deck_.set("Centre", mass.centre);
    deck_.set("Inertia", std::vector<double>{J(0, 0), J(1, 1), J(2, 2), J(1, 2), J(0, 2), J(0, 1)});
    deck_.close();
  }

  void write_joint(std::size_t at) {
    const SubJoint& joint = sub_.joints[at];
    for (std::size_t i = 1; i < ends_[at].size(); ++i) {
      const std::string name = fmt::format("joint {}, {}", joint.id, i);
      const bool is_rigid = joint.kind == SubJoint::Kind::rigid || ends_[at][i].starts_with("mass");
      if (is_rigid) {
        follow(name, ends_[at][i], node_at(at));
      } else {
        const bool turns = joint.kind == SubJoint::Kind::revolute;
        deck_.open(name, turns ? "Revolute Joint" : "Spherical Joint");
        deck_.set("First", node_at(at));
        deck_.set("Second", ends_[at][i]);
        if (turns) deck_.set("Axis", joint.axis);
        deck_.close();
      }
    }
  }

  void follow(const std::string& name, const std::string& node, const std::string& master) {
    deck_.open(name, "Rigid Connection");
    deck_.set("Node", node);
    deck_.set("Master", master);
    deck_.close();
  }

  void weld(const std::string& name, const std::string& first, const std::string& second) {
    deck_.open(name, "Weld");
    deck_.set("First", first);
    deck_.set("Second", second);
    deck_.close();
  }

  void write_rigid_links() {
    for (const SubMember& member : sub_.members) {
      if (member.kind != SubMember::Kind::rigid) continue;
      weld(name_of(member), node_at(member.joints[0]), node_at(member.joints[1]));
      if (mass_of(sub_, member) > 0.0) {
        report_.add(missing,
                    fmt::format("{}: a rigid link, whose mass of {:g} kg is not in the deck",
                                name_of(member), mass_of(sub_, member)));
      }
    }
  }

  void write_interface() {
    for (std::size_t i = 1; i < sub_.interface.size(); ++i) {
      weld(fmt::format("interface {}", i), node_at(sub_.interface.front()),
           node_at(sub_.interface[i]));
    }
    if (sub_.interface.empty()) return;
    report_.add(
        assumed,
        fmt::format(
            "{} carries what stands on the substructure{}", body_at(sub_, sub_.interface.front()),
            sub_.interface.size() > 1 ? ", and the other interface joints are rigid with it" : ""));
  }

  void write_support(const SubSupport& support) {
    const std::string name = body_at(sub_, support.joint) + ", held";
    const std::size_t count =
        static_cast<std::size_t>(std::count(support.held.begin(), support.held.end(), true));
    if (count == 6) {
      deck_.open(name, "Rigid Support");
      deck_.set("Node", node_at(support.joint));
      deck_.close();
      return;
    }
    for (int k = 0; k < 6; ++k) {
      if (!support.held[static_cast<std::size_t>(k)]) continue;
      deck_.open(fmt::format("{}, {}{}", name, k < 3 ? "" : "about ", "xyz"[k % 3]),
                 k < 3 ? "Simple Support" : "Rotation");
      deck_.set("Node", node_at(support.joint));
      deck_.set(k < 3 ? "Direction" : "Axis", Vec3(Vec3::Unit(k % 3)));
      deck_.close();
    }
  }

  const SubDyn& sub_;
  Report& report_;
  DeckWriter& deck_;
  std::vector<std::vector<std::string>> ends_;  // nodes at each joint, the carrying one first
};

}  // namespace

void write_sections(const SubDyn& sub, DeckWriter& deck, Report& report) {
  SubDeck(sub, deck, report).write_sections();
}

void write_structures(const SubDyn& sub, DeckWriter& deck, Report& report) {
  SubDeck(sub, deck, report).write_structures();
}

void write_masses(const SubDyn& sub, DeckWriter& deck, Report& report) {
  SubDeck(sub, deck, report).write_masses();
}

void write_constraints(const SubDyn& sub, DeckWriter& deck, Report& report) {
  SubDeck(sub, deck, report).write_constraints();
}

void write_cables(const SubDyn& sub, DeckWriter& deck, Report& report) {
  SubDeck(sub, deck, report).write_cables();
}

void write_ground(const SubDyn& sub, DeckWriter& deck, Report& report) {
  SubDeck(sub, deck, report).write_ground();
}

void write_history(const SubDyn& sub, DeckWriter& deck, Report& report) {
  SubDeck(sub, deck, report).write_history();
}

void report_masses(const SubDyn& sub, Report& report) {
  DeckWriter none("", {});
  SubDeck(sub, none, report).report_masses();
}

std::string interface_node(const SubDyn& sub) {
  if (sub.interface.empty()) {
    throw InputError({sub.path.string(), 0, "NInterf"}, "must be at least 1, to carry the tower");
  }
  DeckWriter none("", {});
  Report ignored;
  return SubDeck(sub, none, ignored).node_at(sub.interface.front());
}

std::string write_deck(const SubDyn& sub, Report& report) {
  DeckWriter deck(sub.title,
                  {"Shows: a substructure under its own weight, and its modes.",
                   "Imported from " + sub.path.filename().string() + " of OpenFAST.",
                   "z is up; d1, d2, d3 of beams are the axes x, y, z of members. SI units."});
  SubDeck lists(sub, deck, report);
  deck.open("Sections");
  lists.write_sections();
  deck.close();
  deck.open("Structures");
  lists.write_structures();
  deck.close();
  deck.open("Masses");
  lists.write_masses();
  deck.close();
  deck.open("Constraints");
  lists.write_constraints();
  deck.close();
  if (!sub.interface.empty()) report.add(assumed, "nothing stands on the interface here");
  deck.open("Loads");
  deck.open("weight", "Gravity");
  deck.set("Acceleration", Vec3(0.0, 0.0, -gravity));
  deck.close();
  lists.write_cables();
  lists.write_ground();
  deck.close();
  report.add(assumed, fmt::format("weight by {:g} m/s^2, which this file does not say", gravity));
  deck.open("Analyses");
  if (lists.is_held()) {
    deck.open("weight", "Static");
    deck.set("Steps", 1);
    deck.close();
  } else {
    report.add(missing, "no joint is held in all directions: modes are those of a free structure");
  }
  deck.open("modes", "Modal");
  deck.set("Modes", 10);
  deck.close();
  deck.close();
  deck.open("Output");
  deck.open("History");
  lists.write_history();
  deck.close();
  deck.close();
  lists.report_masses();
  return deck.text();
}

}  // namespace culm::openfast
