#include "ended_ramps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace culm::simulation {
namespace {

constexpr const char* remedy =
    "give it a function of its own, such as one of type 'Linear' with a 'Duration' of 1";

bool follows_ramp(const Options& entry) {
  return std::ranges::any_of(entry.parameters(), [](const Options::Parameter& parameter) {
    return parameter.name.ends_with("Function") && parameter.value &&
           std::holds_alternative<std::string>(*parameter.value) &&
           std::get<std::string>(*parameter.value) == "Ramp";
  });
}

bool moves_nothing(const Options& entry) {
  const auto has_amount = [&](const char* name) {
    return std::ranges::any_of(entry.parameters(), [&](const Options::Parameter& parameter) {
      return parameter.name == name && parameter.given;
    });
  };
  return !has_amount("Translation") && !has_amount("Angle");
}

// What follows 'Ramp' in an analysis, loads first: type and name, or nothing.
std::string first_on_ramp(const Options& deck, const Options& analysis) {
  const std::vector<std::string>& inactive = analysis.texts("Inactive");
  for (const char* list : {"Loads", "Constraints"}) {
    for (const Options& entry : deck.list(list).entries()) {
      if (std::ranges::find(inactive, entry.name()) != inactive.end()) continue;
      if (!follows_ramp(entry) || (list[0] == 'C' && moves_nothing(entry))) continue;
      return entry.text("Type") + " '" + entry.name() + "'";
    }
  }
  return {};
}

struct Levels {
  double first, last;
};

// Those of an analysis that looks for equilibrium at levels of its own.
std::optional<Levels> levels_of(const Options& analysis) {
  const std::string& type = analysis.text("Type");
  if (type == "Static") {
    return Levels{analysis.number("Start Level"), analysis.number("Final Level")};
  }
  if (type != "Campbell" && type != "Flutter") return {};
  const std::vector<double>& levels = analysis.numbers("Levels");
  if (levels.empty()) return {};
  return Levels{*std::ranges::min_element(levels), *std::ranges::max_element(levels)};
}

bool grows_by_more_than_ramp(const Options& deck) {
  return std::ranges::any_of(std::vector{"Functions", "Signals", "Fields", "Flows"},
                             [&](const char* list) { return !deck.list(list).entries().empty(); });
}

}  // namespace

std::vector<std::string> levels_beyond_ramp(const Options& deck, const Options& analysis) {
  const std::optional<Levels> levels = levels_of(analysis);
  if (!levels || levels->first >= 1.0 || levels->last <= 1.0) return {};
  if (grows_by_more_than_ramp(deck)) return {};
  const std::string what = first_on_ramp(deck, analysis);
  if (what.empty()) return {};
  return {fmt::format("nothing grows beyond level 1, where 'Ramp' ends, which {} follows: {}", what,
                      remedy)};
}

std::vector<std::string> ramps_cut_off(const Options& deck, const Options& analysis, double level) {
  double begin = level;
  if (analysis.text("Type") == "Static") begin = analysis.number("Start Level");
  if (analysis.text("Type") == "Dynamic" && analysis.has("Start Time")) {
    begin = analysis.number("Start Time");
  }
  if (begin >= 0.0 && begin <= 1.0) return {};
  const std::string what = first_on_ramp(deck, analysis);
  if (what.empty()) return {};
  return {
      fmt::format("the path before it ended at level {:g}, but '{}' holds 'Ramp', which {} "
                  "follows, between 0 and 1, where it jumps to: {}",
                  level, analysis.name(), what, remedy)};
}

}  // namespace culm::simulation
