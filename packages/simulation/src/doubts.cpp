#include "doubts.hpp"

#include <culm/water/doubts.hpp>

#include "contact_findings.hpp"
#include "ended_ramps.hpp"
#include "gravity_and_sea.hpp"
#include "lost_moments.hpp"
#include "relaxing_stresses.hpp"
#include "weightless.hpp"
#include "widths_in_media.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::simulation {
namespace {

bool has_entry_of(const Options& list, const std::string& type) {
  return std::ranges::any_of(list.entries(),
                             [&](const Options& entry) { return entry.text("Type") == type; });
}

bool has_lost_velocities(const Options& deck) {
  return has_entry_of(deck.list("Initial Conditions"), "Velocity") &&
         !has_entry_of(deck.list("Analyses"), "Dynamic");
}

// A place does not tell full turns.
std::vector<std::string> starts_beyond_half_turn(const Options& deck) {
  std::vector<std::string> sentences;
  const auto counts_turns = [](const Options& load) {
    return load.text("Type").starts_with("Torsion");
  };
  if (std::ranges::none_of(deck.list("Loads").entries(), counts_turns)) return sentences;
  for (const Options& start : deck.list("Initial Conditions").entries()) {
    if (start.text("Type") != "Displacement") continue;
    const double angle = start.number("Angle");
    if (std::abs(angle) <= (1.0 + 1e-9) * std::numbers::pi) continue;
    sentences.push_back(fmt::format(
        "{}: turns by {:g} rad, which is more than half a turn: springs and drives that "
        "count turns begin at {:g} rad",
        to_string(start.where("Angle")), angle, std::remainder(angle, 2.0 * std::numbers::pi)));
  }
  return sentences;
}

}  // namespace

void tell_of_deck(const Options& deck, Findings& findings, const Log& log) {
  for (const std::string& sentence : weightless_structures(deck)) log.info("note: " + sentence);
  for (const std::string& sentence : starts_beyond_half_turn(deck)) {
    findings.warn("memory", sentence, 0.0);
  }
  if (has_lost_velocities(deck)) {
    findings.warn("initial velocities",
                  "the initial velocities of the deck are lost: they act in analyses of type "
                  "'Dynamic' only, and there is none",
                  0.0);
  }
}

void warn_before(const Options& deck, const Options& analysis, const model::Model& model,
                 const model::State& state, Findings& findings) {
  const auto warn = [&](const char* kind, const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) findings.warn(kind, sentence, state.time);
  };
  warn("left out", water::left_out_of_bodies(model));
  warn("gravity", weights_that_miss_seas(deck, analysis));
  warn("width", widths_that_differ(deck, analysis, model));
  warn("ended ramp", levels_beyond_ramp(deck, analysis));
  warn("relaxation", stresses_without_branches(deck, analysis));
  warn("overlap", deep_contacts(model, state.next));
  if (analysis.text("Type") != "Dynamic") warn("friction", contacts_at_rest(model));
  warn("lost moment", moments_that_are_not_carried(model));
}

// Ports show rates by the mean velocity, 2 Dq / h - v, which other schemes have as well.
void warn_of_rates(const Options& analysis, const model::State& state, Findings& findings) {
  if (analysis.text("Type") != "Dynamic" || analysis.text("Scheme") != "Generalised Alpha") return;
  findings.warn(
      "port",
      "ports show velocities and accelerations of steps that are not accepted yet as the scheme "
      "'Conserving' has them; those of 'Generalised Alpha' are others, by up to some percent of "
      "what the step changes; take 'Conserving', or positions and motions",
      state.time);
}

}  // namespace culm::simulation
