#include "hydrodyn_deck.hpp"

#include <culm/base/error.hpp>

#include "floater.hpp"
#include "headings.hpp"
#include "hydro_member.hpp"
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

// Of the part of the members below still water, by cones [m^3].
double displaced_volume(const HydroDyn& hydro) {
  double volume = 0.0;
  const double bed = hydro.sea.level - hydro.sea.depth;
  for (const HydroMember& member : hydro.members) {
    if (member.is_potential) continue;
    const Vec3 &a = hydro.joints[member.joints[0]].place, &b = hydro.joints[member.joints[1]].place;
    constexpr int parts = 1000;  // of the length
    for (int i = 0; i < parts; ++i) {
      const double s = (i + 0.5) / parts, z = std::lerp(a.z(), b.z(), s);
      if (z > hydro.sea.level || z < bed) continue;
      const double d = std::lerp(member.diameters[0], member.diameters[1], s);
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
std::optional<MemberCarrier> along(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b) {
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
  return MemberCarrier{{}, {}, {of_member(low), of_member(high)}, {low, high}};
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
    MemberCarrier carrier{body};
    carrier.floats = floats;
    write_member(hydro, member, carrier, name_of(member), deck, report);
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
      const double radius = 0.5 * std::lerp(member.diameters[0], member.diameters[1], s) -
                            std::lerp(member.walls[0], member.walls[1], s);
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
      if (write_member(hydro, member, *carrier, name, deck, report)) names.push_back(name);
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
