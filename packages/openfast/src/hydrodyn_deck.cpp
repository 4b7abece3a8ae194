#include "hydrodyn_deck.hpp"

#include <culm/base/error.hpp>

#include "floater.hpp"
#include "headings.hpp"
#include "sea_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace culm::openfast {

namespace {

// Parts of a length below it are rounding of files.
constexpr double least_share = 1e-4;

double mix(double a, double b, double share) { return a + share * (b - a); }

HydroCoefficients mix(const HydroCoefficients& a, const HydroCoefficients& b, double share) {
  return {mix(a.drag, b.drag, share), mix(a.added_mass, b.added_mass, share),
          mix(a.pressure, b.pressure, share), mix(a.buoyancy, b.buoyancy, share)};
}

// What a member has at a place of its length.
struct Section {
  double place = 0.0;  // from 0 to 1
  double diameter = 0.0, wall = 0.0, growth = 0.0, density = 0.0;
  HydroCoefficients coefficients;
};

// What carries a member: a body with its node at the origin, or a beam along the member.
struct Carrier {
  std::string body = {};
  std::string beam = {};
  std::array<double, 2> of_member = {0.0, 1.0};  // the part of the member's length on the beam
  std::array<double, 2> of_beam = {0.0, 1.0};    // the same part of the beam's, rising
  bool floats = false;                           // what fills a member is a body of its own
};

class MemberWriter {
 public:
  MemberWriter(const HydroDyn& hydro, const HydroMember& member, Carrier carrier, Report& report)
      : hydro_(hydro), member_(member), carrier_(std::move(carrier)), report_(report) {
    const Vec3 &from = hydro.joints[member.joints[0]].place,
               &to = hydro.joints[member.joints[1]].place;
    for (std::size_t end = 0; end < 2; ++end) {
      place_[end] = from + carrier_.of_member[end] * (to - from);
    }
  }

  // @return whether there is anything above the bed
  bool write(const std::string& name, DeckWriter& deck) {
    const double bed = hydro_.sea.level - hydro_.sea.depth;
    const std::optional<std::array<double, 2>> range = above(bed);
    if (!range) {
      report_.add(assumed, name + ": is below the bed, and not in the deck");
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
    if (!member_.has_buoyancy || is_drag_only()) deck.set("Buoyancy", "false");
    if (is_drag_only()) deck.set("Pull", "false");
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
    return s == 1.0 ? carrier_.of_beam[1] : mix(carrier_.of_beam[0], carrier_.of_beam[1], s);
  }
  double on_member(double s) const { return mix(carrier_.of_member[0], carrier_.of_member[1], s); }
  double height(double s) const { return mix(place_[0].z(), place_[1].z(), s); }

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
        add_height(hydro_.sea.level - one.depth, places);
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
    section.diameter = mix(member_.diameters[0], member_.diameters[1], on_member(s));
    section.wall = mix(member_.walls[0], member_.walls[1], on_member(s));
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
      section.growth = mix(below.thickness, up.thickness, share);
      section.density = mix(below.density, up.density, share);
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
    const double depth = hydro_.sea.level - height(s);
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
    const HydroJoint &first = hydro_.joints[member_.joints[0]],
                     &last = hydro_.joints[member_.joints[1]];
    const double drag = std::max(first.drag, last.drag);
    const double added_mass = std::max(first.added_mass, last.added_mass);
    if (drag > 0.0) deck.set("End Drag", drag);
    if (added_mass > 0.0 && !is_drag_only()) deck.set("End Added Mass", added_mass);
    if (dry.empty() && (first.drag != last.drag || first.added_mass != last.added_mass)) {
      report_.add(assumed, fmt::format("member {}: both of its faces have the larger axial "
                                       "coefficients of its joints",
                                       member_.id));
    }
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
  Carrier carrier_;
  Report& report_;
  std::array<Vec3, 2> place_;
  std::vector<Section> sections_;
};

// Of the part of the members below still water, by cones [m^3].
double displaced_volume(const HydroDyn& hydro) {
  double volume = 0.0;
  const double bed = hydro.sea.level - hydro.sea.depth;
  for (const HydroMember& member : hydro.members) {
    if (member.is_potential) continue;
    const Vec3 &a = hydro.joints[member.joints[0]].place, &b = hydro.joints[member.joints[1]].place;
    constexpr int parts = 1000;  // of the length
    for (int i = 0; i < parts; ++i) {
      const double s = (i + 0.5) / parts, z = mix(a.z(), b.z(), s);
      if (z > hydro.sea.level || z < bed) continue;
      const double d = mix(member.diameters[0], member.diameters[1], s);
      volume += 0.25 * std::numbers::pi * d * d * (b - a).norm() / parts;
    }
  }
  return volume;
}

std::string name_of(const HydroMember& member) { return fmt::format("member {}", member.id); }

bool is_left_out(const HydroMember& member, Report& report) {
  if (!member.is_potential) return false;
  report.add(missing, name_of(member) + ": is left to potential flow, and not in the deck");
  return true;
}

void report_hull(const HydroDyn& hydro, Report& report) {
  for (const HydroFilling& filling : hydro.fillings) {
    const HydroMember& member = hydro.members[filling.member];
    if (member.is_flooded) continue;
    report.add(missing,
               fmt::format("{}: is filled with {:g} kg/m^3 up to {:g} m, not with the sea: "
                           "give the body its mass",
                           name_of(member), filling.density, filling.level));
  }
  if (hydro.potential) {
    report.add(missing, hydro.path.string() + ": potential flow, PotMod, is not in the deck");
  }
  if (hydro.added.is_zero) return;
  report.add(missing,
             hydro.path.string() + ": additional forces, stiffness or damping of the platform");
}

std::vector<double> by_rows(const Mat6& matrix) {
  const Mat6 rows = matrix.transpose();
  return {rows.data(), rows.data() + rows.size()};
}

// Files of hulls with several columns need more poles than culm takes by itself, and are fitted
// less well: by 0.053 that of the VolturnUS-S of IEA's 15 MW turbine.
constexpr int poles = 10;
constexpr double fit = 0.1;

// The part of a member that lies along a beam from a to b; none if they only meet or are apart.
std::optional<Carrier> along(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b) {
  const Vec3 axis = (b - a).normalized();
  const double length = (b - a).norm(), near = 1e-3 * length;
  const auto beside = [&](const Vec3& x) {
    const Vec3 arm = x - a;
    return (arm - arm.dot(axis) * axis).norm();
  };
  if (beside(from) > near || beside(to) > near) return {};
  const double t0 = (from - a).dot(axis) / length, t1 = (to - a).dot(axis) / length;
  const double low = std::clamp(std::min(t0, t1), 0.0, 1.0);
  const double high = std::clamp(std::max(t0, t1), 0.0, 1.0);
  if (high - low < least_share) return {};
  const auto of_member = [&](double t) { return std::clamp((t - t0) / (t1 - t0), 0.0, 1.0); };
  return Carrier{{}, {}, {of_member(low), of_member(high)}, {low, high}};
}

void report_all(const HydroDyn& hydro, Report& report) {
  report.add(checked, fmt::format("volume of members below still water, without growth: {:.5g} m^3",
                                  displaced_volume(hydro)));
  report.add(
      assumed,
      "axial coefficients of sections, AxCd, AxCa, AxCp, act there on cones only, and are not "
      "in the deck");
}

}  // namespace

void write_hull(const HydroDyn& hydro, const std::string& body, const std::filesystem::path& folder,
                DeckWriter& deck, Report& report) {
  if (hydro.potential) {
    const HydroPotential& flow = *hydro.potential;
    deck.open("hull", "Potential Flow");
    deck.set("Node", body);
    deck.set("Flow", sea_name);
    deck.set("File Name", name_from(folder, flow.root.string() + ".1"));
    if (flow.length != 1.0) deck.set("Length", flow.length);
    deck.set("Volume", flow.volume);
    if (flow.centre_x != 0.0 || flow.centre_y != 0.0) {
      deck.set("Centre", Vec3(flow.centre_x, flow.centre_y, 0.0));
    }
    if (flow.radiates) {
      deck.set("Poles", poles);
      deck.set("Fit", fit);
    } else {
      deck.set("Poles", 0);
    }
    deck.close();
    const double lift = hydro.sea.density * hydro.sea.gravity * flow.volume;
    report.add(checked, fmt::format("the water lifts the hull by {:.6g} N, the weight of {:.6g} kg",
                                    lift, hydro.sea.density * flow.volume));
    report.add(assumed, fmt::format("waves that the hull makes: fitted by poles, with an error of "
                                    "at most {:g}; no forces of second order",
                                    fit));
  }
  if (hydro.added.is_zero) return;
  deck.open("added to the platform", "Restoring");
  deck.set("Node", body);
  deck.set("Preload", hydro.added.preload);
  const std::pair<const char*, const Mat6*> matrices[] = {
      {"Stiffness", &hydro.added.stiffness},
      {"Damping", &hydro.added.damping},
      {"Quadratic Damping", &hydro.added.quadratic}};
  for (const auto& [name, matrix] : matrices) {
    if (!matrix->isZero(0.0)) deck.set(name, by_rows(*matrix));
  }
  deck.close();
}

void write_members(const HydroDyn& hydro, const std::string& body, bool floats, DeckWriter& deck,
                   Report& report) {
  for (const HydroMember& member : hydro.members) {
    if (member.is_potential && !hydro.potential) {
      is_left_out(member, report);
      continue;
    }
    Carrier carrier{body};
    carrier.floats = floats;
    MemberWriter(hydro, member, carrier, report).write(name_of(member), deck);
  }
  report_all(hydro, report);
}

Ballast ballast_of(const HydroDyn& hydro) {
  Ballast ballast;
  constexpr int parts = 1000;  // of the length
  for (const HydroFilling& filling : hydro.fillings) {
    const HydroMember& member = hydro.members[filling.member];
    const Vec3 &a = hydro.joints[member.joints[0]].place, &b = hydro.joints[member.joints[1]].place;
    const Vec3 axis = (b - a).normalized();
    for (int i = 0; i < parts; ++i) {
      const double s = (i + 0.5) / parts;
      const Vec3 place = (1.0 - s) * a + s * b;
      if (place.z() > filling.level) continue;
      const double radius = 0.5 * mix(member.diameters[0], member.diameters[1], s) -
                            mix(member.walls[0], member.walls[1], s);
      const double mass =
          filling.density * std::numbers::pi * radius * radius * (b - a).norm() / parts;
      ballast.mass += mass;
      ballast.centre += mass * place;
      ballast.inertia +=
          mass * (place.squaredNorm() * Mat3::Identity() - place * place.transpose());
      ballast.inertia +=
          0.25 * mass * radius * radius * (Mat3::Identity() + axis * axis.transpose());
    }
  }
  if (ballast.mass == 0.0) return ballast;
  const Vec3 centre = ballast.centre / ballast.mass;
  ballast.inertia -=
      ballast.mass * (centre.squaredNorm() * Mat3::Identity() - centre * centre.transpose());
  ballast.centre = centre;
  return ballast;
}

std::vector<std::string> write_members(const HydroDyn& hydro, const SubDyn& sub, DeckWriter& deck,
                                       Report& report) {
  std::vector<std::string> names;
  report_hull(hydro, report);
  for (const HydroMember& member : hydro.members) {
    if (is_left_out(member, report)) continue;
    const Vec3 &from = hydro.joints[member.joints[0]].place,
               &to = hydro.joints[member.joints[1]].place;
    double carried = 0.0;
    for (const SubMember& beam : sub.members) {
      if (beam.kind != SubMember::Kind::beam) continue;
      auto carrier =
          along(from, to, sub.joints[beam.joints[0]].place, sub.joints[beam.joints[1]].place);
      if (!carrier) continue;
      carried += std::abs(carrier->of_member[1] - carrier->of_member[0]);
      carrier->beam = fmt::format("member {}", beam.id);
      const std::string name = fmt::format("water on {}, {}", carrier->beam, name_of(member));
      MemberWriter writer(hydro, member, *carrier, report);
      if (writer.write(name, deck)) names.push_back(name);
    }
    if (carried > 1.0 + least_share) {
      throw InputError({hydro.path.string(), 0, name_of(member)},
                       "lies along beams of SubDyn that lie upon each other, which would all carry "
                       "its water");
    }
    if (carried < 1.0 - least_share) {
      report.add(missing, fmt::format("{} of HydroDyn: {:.3g} m of {:.3g} m lie along no beam of "
                                      "SubDyn, and have no water",
                                      name_of(member), (1.0 - carried) * (to - from).norm(),
                                      (to - from).norm()));
    }
  }
  report_all(hydro, report);
  return names;
}

std::string write_deck(const HydroDyn& hydro, Report& report) {
  DeckWriter deck(hydro.title, {"Shows: the sea on the members of a platform that does not move.",
                                "Imported from " + hydro.path.filename().string() + " and " +
                                    hydro.sea.path.filename().string() + " of OpenFAST.",
                                "z is up, 0 at mean sea level. SI units."});
  write_held_body(platform_name, "held", deck);
  write_flows(hydro.sea, deck);
  deck.open("Loads");
  report_hull(hydro, report);
  write_members(hydro, platform_name, false, deck, report);
  deck.close();
  deck.open("Analyses");
  deck.open("sea", "Dynamic");
  deck.set("Start Time", 0.0);
  deck.set("End Time", 60.0);
  deck.set("Step", 0.1);
  deck.close();
  deck.close();
  deck.open("Output");
  deck.set("Every", 10);
  deck.open("History");
  deck.open("force of the sea", "Reaction");
  deck.set("Node", platform_name);
  deck.close();
  deck.close();
  deck.close();
  report.add(assumed,
             "the platform is held at the origin: what the sea exerts is the reaction there, "
             "with its sign changed; 60 s");
  return deck.text();
}

}  // namespace culm::openfast
