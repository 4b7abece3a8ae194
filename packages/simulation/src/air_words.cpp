#include "air_words.hpp"

#include <culm/lattice/lattice_load.hpp>
#include <culm/rotor/rotor_load.hpp>
#include <culm/strip/strip_load.hpp>

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace culm::simulation {
namespace {

std::string describe(const strip::StripLoad& strips) {
  if (strips.effect().type == "Strip Drag") return "drag across the axis";
  const strip::StripModel& kind = strips.kind();
  const bool is_jones = kind.lag.states > 0 && kind.lag.amplitude == strip::Lag::jones().amplitude;
  const std::string stall = kind.stall == strip::Stall::oye           ? "stall by Oye's state"
                            : kind.stall == strip::Stall::four_states ? "stall by four states"
                                                                      : "stall at once";
  const std::string lag = kind.lag.states == 0 ? "no lag"
                          : is_jones           ? "lag of Jones"
                                               : "lag with constants of airfoils";
  return lag + ", " + stall + (kind.apparent_mass ? ", apparent mass" : ", no apparent mass") +
         (strips.inducer() == nullptr ? ", nothing induced" : "");
}

std::string describe(const rotor::RotorLoad& rotor) {
  const rotor::RotorModel& kind = rotor.kind();
  if (kind.follow == rotor::Follow::none) return "nothing is induced";
  const std::string wakes = kind.follow == rotor::Follow::dynamic  ? "wakes that follow with lags"
                            : kind.follow == rotor::Follow::steady ? "steady wakes"
                                                                   : "wakes of the first step";
  const std::string losses = kind.losses.tip && kind.losses.hub ? "losses at tip and hub"
                             : kind.losses.tip                  ? "losses at the tip"
                             : kind.losses.hub                  ? "losses at the hub"
                                                                : "no losses";
  return wakes + ", " + losses + (kind.drag_induces ? ", drag induces" : ", drag does not induce") +
         (kind.skewed_wake ? ", skewed wakes" : ", no skew of wakes");
}

std::string describe(const lattice::LatticeLoad& load) {
  const lattice::LatticeSetting& setting = load.lattice().setting();
  const lattice::Wake& wake = load.fluid().wake;
  std::string text = fmt::format("{} rings", load.lattice().bound().num_rings());
  if (wake.rows() == 1) {
    text += ", steady, its wake straight";
  } else if (wake.rows() > 1) {
    text +=
        fmt::format(", {} wake of {} rows",
                    setting.wake == lattice::WakeMotion::free ? "free" : "prescribed", wake.rows());
    text += wake.rows() == setting.rows ? ", cut there by 'Rows'" : ", none lost";
  }
  return text + (load.left_out_of_modes().empty() ? "" : "; modes leave out how its forces change");
}

}  // namespace

std::string describe_air(const model::Model& model) {
  struct Line {
    std::string who, what;
    int others = 0;
  };
  std::vector<Line> lines;
  const auto add = [&](std::string who, std::string what) {
    for (Line& line : lines) {
      if (line.what != what) continue;
      ++line.others;
      return;
    }
    lines.push_back({std::move(who), std::move(what)});
  };
  for (const auto& load : model.loads()) {
    const std::string who = load->effect().quoted();
    if (const auto* strips = dynamic_cast<const strip::StripLoad*>(load.get())) {
      add(who, describe(*strips));
    } else if (const auto* rotor = dynamic_cast<const rotor::RotorLoad*>(load.get())) {
      add(fmt::format("{}, {} blades", who, rotor->blades().size()), describe(*rotor));
    } else if (const auto* lattice = dynamic_cast<const lattice::LatticeLoad*>(load.get())) {
      add(who, describe(*lattice));
    }
  }
  std::string text;
  for (const Line& line : lines) {
    const std::string more = line.others > 0 ? fmt::format(" and {} more", line.others) : "";
    text += fmt::format("air: {}{}: {}\n", line.who, more, line.what);
  }
  return text;
}

}  // namespace culm::simulation
