#include "hydro_member.hpp"

#include "headings.hpp"
#include "sea_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace culm::openfast {
namespace {

HydroCoefficients mix(const HydroCoefficients& a, const HydroCoefficients& b, double share) {
  return {std::lerp(a.drag, b.drag, share), std::lerp(a.added_mass, b.added_mass, share),
          std::lerp(a.pressure, b.pressure, share), std::lerp(a.buoyancy, b.buoyancy, share)};
}

// What a member has at a place of its length.
struct Section {
  double place = 0.0;  // from 0 to 1
  double diameter = 0.0, wall = 0.0, growth = 0.0, density = 0.0;
  HydroCoefficients coefficients;
};

class MemberWriter {
 public:
  MemberWriter(const HydroDyn& hydro, const HydroMember& member, MemberCarrier carrier,
               Report& report)
      : hydro_(hydro), member_(member), carrier_(std::move(carrier)), report_(report) {
    const Vec3 &from = hydro.joints[member.joints[0]].place,
               &to = hydro.joints[member.joints[1]].place;
    for (std::size_t end = 0; end < 2; ++end) {
      place_[end] = from + carrier_.of_member[end] * (to - from);
    }
  }

  // @return whether there is anything above the bed and of any length
  bool write(const std::string& name, DeckWriter& deck) {
    const double bed = hydro_.sea.level - hydro_.sea.depth;
    const std::optional<std::array<double, 2>> range = above(bed);
    if (!range) {
      report_.add(assumed, name + ": is below the bed, and not in the deck");
      return false;
    }
    if (is_slice()) {
      report_.add(assumed, name +
                               ": is a slice of less than a hundredth of its diameter between "
                               "others, on which no water acts in the deck");
      return false;
    }
    make_sections();
    deck.open(name, "Morison");
    if (carrier_.beam.empty()) {
      deck.set("Node", carrier_.body);
      deck.set("From", place_[0]);
      deck.set("To", place_[1]);
    } else {
      deck.set("Structure", carrier_.beam);
    }
    deck.set("Flow", sea_name);
    const double first = on_carrier((*range)[0]), last = on_carrier((*range)[1]);
    if (first > 0.0 || last < 1.0) deck.set("Range", std::vector<double>{first, last});
    write_sections(deck);
    const bool presses = member_.has_buoyancy && !is_drag_only();
    // beside potential flow a member has to say what it has of the water
    if (!presses || hydro_.potential) deck.set("Buoyancy", presses ? "true" : "false");
    if (is_drag_only() || hydro_.potential) deck.set("Pull", is_drag_only() ? "false" : "true");
    write_ends(*range, bed, deck);
    deck.close();
    report_coefficients(name);
    return true;
  }

 private:
  // The rest is potential flow's.
  bool is_drag_only() const { return member_.is_potential; }

  // s is the fraction of the part that is written, from its first end to its last.
  double on_carrier(double s) const {
    return std::lerp(carrier_.of_beam[0], carrier_.of_beam[1], s);
  }
  double on_member(double s) const {
    return std::lerp(carrier_.of_member[0], carrier_.of_member[1], s);
  }
  double height(double s) const { return std::lerp(place_[0].z(), place_[1].z(), s); }

  // Nothing but a place where others meet: members, or beams that carry one of them.
  bool is_slice() const {
    const double width = std::max(member_.diameters[0], member_.diameters[1]);
    const auto meets = [this](std::size_t end) {
      return goes_on(end) || free_share(end, 2) == 0.0;
    };
    return (place_[1] - place_[0]).norm() < 0.01 * width && meets(0) && meets(1);
  }

  // The part that is not below a height.
  std::optional<std::array<double, 2>> above(double bed) const {
    const double first = place_[0].z() - bed, second = place_[1].z() - bed;
    const double near = 1e-6 * hydro_.sea.depth;
    if (first <= near && second <= near) return {};
    std::array<double, 2> range = {0.0, 1.0};
    if (first < -near || second < -near) range[first < second ? 0 : 1] = first / (first - second);
    return range;
  }

  // Where tables have their lines, on the length of this member.
  void add_height(double z, std::vector<double>& places) const {
    const double difference = place_[1].z() - place_[0].z();
    if (difference == 0.0) return;
    const double s = (z - place_[0].z()) / difference;
    if (s > 0.0 && s < 1.0) places.push_back(s);
  }

  void make_sections() {
    std::vector<double> places = {0.0, 1.0};
    if (member_.coefficients == 2) {
      for (const HydroDepth& one : hydro_.by_depth) {
        add_height(-one.depth, places);
      }
    }
    for (const HydroGrowth& one : hydro_.growth) add_height(one.height, places);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      // from the middle of the piece it is seen whether there is growth at its ends
      const double middle = 0.5 * (places[i] + places[i + 1]);
      for (const double s : {places[i], places[i + 1]}) add_section(s, middle);
    }
    // lists go from end to end of a beam, whatever part of it is in the range
    for (Section& section : sections_) section.place = on_carrier(section.place);
    if (sections_.front().place > 0.0) {
      sections_.insert(sections_.begin(), sections_.front());
      sections_.front().place = 0.0;
    }
    if (sections_.back().place < 1.0) {
      sections_.push_back(sections_.back());
      sections_.back().place = 1.0;
    }
  }

  void add_section(double s, double middle) {
    Section section;
    section.place = s;
    section.diameter = std::lerp(member_.diameters[0], member_.diameters[1], on_member(s));
    section.wall = std::lerp(member_.walls[0], member_.walls[1], on_member(s));
    const bool grown = grow(section, s, middle);
    section.coefficients = coefficients(s, grown ? 1 : 0);
    if (!sections_.empty() && is_same(sections_.back(), section)) return;
    sections_.push_back(section);
  }

  static bool is_same(const Section& a, const Section& b) {
    return a.place == b.place && a.growth == b.growth && a.density == b.density &&
           a.coefficients.drag == b.coefficients.drag &&
           a.coefficients.added_mass == b.coefficients.added_mass;
  }

  // Growth is between the first and the last of its depths.
  bool grow(Section& section, double s, double middle) const {
    const auto& growth = hydro_.growth;
    const double z = height(middle);
    for (std::size_t i = 0; i + 1 < growth.size(); ++i) {
      const HydroGrowth &below = growth[i], &up = growth[i + 1];
      if (z < below.height || z > up.height || up.height == below.height) continue;
      const double share = (height(s) - below.height) / (up.height - below.height);
      section.growth = std::lerp(below.thickness, up.thickness, share);
      section.density = std::lerp(below.density, up.density, share);
      return below.thickness > 0.0 || up.thickness > 0.0;
    }
    return false;
  }

  HydroCoefficients coefficients(double s, std::size_t grown) const {
    if (member_.coefficients == 1) return hydro_.simple[grown];
    if (member_.coefficients == 3) {
      return mix(member_.own[0][grown], member_.own[1][grown], on_member(s));
    }
    const auto& depths = hydro_.by_depth;
    const double depth = -height(s);
    if (depth <= depths.front().depth) return depths.front().coefficients[grown];
    for (std::size_t i = 0; i + 1 < depths.size(); ++i) {
      if (depth > depths[i + 1].depth) continue;
      const double share = (depth - depths[i].depth) / (depths[i + 1].depth - depths[i].depth);
      return mix(depths[i].coefficients[grown], depths[i + 1].coefficients[grown], share);
    }
    return depths.back().coefficients[grown];
  }

  std::vector<double> values(double (*of)(const Section&)) const {
    std::vector<double> list;
    for (const Section& section : sections_) list.push_back(of(section));
    return list;
  }

  // One number where it is the same everywhere, else a list at the positions.
  void write_values(const char* one, const char* several, const std::vector<double>& list,
                    DeckWriter& deck) const {
    if (std::all_of(list.begin(), list.end(), [&](double v) { return v == list.front(); })) {
      deck.set(one, list.front());
    } else {
      deck.set(several, list);
    }
  }

  void write_sections(DeckWriter& deck) {
    const auto diameters = values([](const Section& s) { return s.diameter; });
    const auto inner = values([](const Section& s) { return s.diameter - 2.0 * s.wall; });
    const auto drags = values([](const Section& s) { return s.coefficients.drag; });
    const auto masses = values([](const Section& s) { return s.coefficients.added_mass; });
    const auto growths = values([](const Section& s) { return s.growth; });
    const auto varies = [](const std::vector<double>& list) {
      return std::any_of(list.begin(), list.end(), [&](double v) { return v != list.front(); });
    };
    const bool floods = member_.is_flooded && inner.front() > 0.0 && !carrier_.floats;
    if (varies(diameters) || varies(drags) || varies(masses) || varies(growths) ||
        (floods && varies(inner))) {
      deck.set("Positions", values([](const Section& s) { return s.place; }));
    }
    write_values("Diameter", "Diameters", diameters, deck);
    if (floods) write_values("Flooded Diameter", "Flooded Diameters", inner, deck);
    write_values("Drag", "Drags", drags, deck);
    if (is_drag_only()) {
      deck.set("Added Mass", 0.0);
    } else {
      write_values("Added Mass", "Added Masses", masses, deck);
    }
    write_growth(growths, deck);
  }

  void write_growth(const std::vector<double>& growths, DeckWriter& deck) {
    double volume = 0.0, mass = 0.0;
    for (const Section& section : sections_) {
      volume += section.growth;
      mass += section.growth * section.density;
    }
    if (!(volume > 0.0)) return;
    write_values("Growth", "Growths", growths, deck);
    deck.set("Growth Density", mass / volume);
    for (const Section& section : sections_) {
      if (section.growth == 0.0 || std::abs(section.density * volume / mass - 1.0) < 1e-9) continue;
      report_.add(assumed, fmt::format("member {}: growth has one density, the mean {:g} kg/m^3",
                                       member_.id, mass / volume));
      return;
    }
  }

  // Whether there is no face, because the member is longer than its part on this beam.
  bool goes_on(std::size_t end) const {
    const double s = carrier_.of_member[end];
    return s > least_share && s < 1.0 - least_share;
  }

  // Faces at or below the bed are dry.
  void write_ends(const std::array<double, 2>& range, double bed, DeckWriter& deck) const {
    std::vector<std::string> dry;
    const double near = 1e-3 * hydro_.sea.depth;
    if (range[0] > 0.0 || goes_on(0) || place_[0].z() - bed <= near) dry.emplace_back("first");
    if (range[1] < 1.0 || goes_on(1) || place_[1].z() - bed <= near) dry.emplace_back("last");
    if (!dry.empty()) deck.set("Dry Ends", dry);
    std::vector<double> drags, masses;
    for (std::size_t end = 0; end < 2; ++end) {
      const HydroJoint& joint = hydro_.joints[member_.joints[end]];
      // HydroDyn's force is rho / 4 times its coefficient, ours rho / 2
      drags.push_back(0.5 * joint.drag * free_share(end, 2));
      masses.push_back(is_drag_only() ? 0.0 : joint.added_mass * free_share(end, 3));
    }
    if (drags[0] + drags[1] > 0.0) write_values("End Drag", "End Drags", drags, deck);
    if (masses[0] + masses[1] > 0.0) {
      write_values("End Added Mass", "End Added Masses", masses, deck);
    }
  }

  // What other members leave of a face that go on there: of its area by the squares of diameters,
  // of the water before it by their cubes.
  double free_share(std::size_t end, int power) const {
    const std::size_t joint = member_.joints[end];
    const double own = std::pow(member_.diameters[end], power);
    double covered = 0.0;
    for (const HydroMember& other : hydro_.members) {
      for (std::size_t its = 0; its < 2; ++its) {
        if (other.id == member_.id || other.joints[its] != joint) continue;
        if (inward(other, its).dot(inward(member_, end)) > -0.999) continue;
        covered += std::pow(other.diameters[its], power);
      }
    }
    return own > 0.0 ? std::max(1.0 - covered / own, 0.0) : 1.0;
  }

  // Along a member from one of its ends to the other.
  Vec3 inward(const HydroMember& member, std::size_t end) const {
    const Vec3 &from = hydro_.joints[member.joints[end]].place,
               &to = hydro_.joints[member.joints[1 - end]].place;
    return (to - from).normalized();
  }

  void report_coefficients(const std::string& name) const {
    for (const Section& section : sections_) {
      if (section.coefficients.pressure != 1.0) {
        report_.add(not_used,
                    fmt::format("{}: Cp = {:g}; the force of the undisturbed water is whole", name,
                                section.coefficients.pressure));
        break;
      }
    }
    for (const Section& section : sections_) {
      if (section.coefficients.buoyancy != 1.0) {
        report_.add(not_used, fmt::format("{}: Cb = {:g}; buoyancy is that of the volume", name,
                                          section.coefficients.buoyancy));
        break;
      }
    }
  }

  const HydroDyn& hydro_;
  const HydroMember& member_;
  MemberCarrier carrier_;
  Report& report_;
  std::array<Vec3, 2> place_;
  std::vector<Section> sections_;
};

}  // namespace

bool write_member(const HydroDyn& hydro, const HydroMember& member, const MemberCarrier& carrier,
                  const std::string& name, DeckWriter& deck, Report& report) {
  return MemberWriter(hydro, member, carrier, report).write(name, deck);
}

}  // namespace culm::openfast
