#include "earlier_states.hpp"

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace culm::simulation {

EarlierStates::EarlierStates(const Options& analyses) {
  InputIssues issues;
  std::vector<std::string> before = {reference};
  for (const Options& entry : analyses.entries()) {
    if (entry.has("Start From")) {
      const std::string& from = entry.text("Start From");
      std::error_code ignored;
      if (std::find(before.begin(), before.end(), from) != before.end()) {
        if (from != reference) wanted_.insert(from);
      } else if (!std::filesystem::exists(from, ignored)) {
        issues.add(entry.where("Start From"), "there is no earlier analysis and no checkpoint '" +
                                                  from + "'" + did_you_mean(from, before));
      }
    }
    before.push_back(entry.name());
  }
  issues.throw_if_any();
}

bool EarlierStates::wants_reference(const Options& analyses) {
  return std::any_of(analyses.entries().begin(), analyses.entries().end(),
                     [](const Options& entry) {
                       return entry.has("Start From") && entry.text("Start From") == reference;
                     });
}

void EarlierStates::keep(const std::string& name, std::size_t analysis, Snapshot state) {
  kept_[name] = {analysis, std::move(state)};
}

const EarlierStates::Kept& EarlierStates::find(const std::string& name) const {
  const auto found = kept_.find(name);
  internal_check(found != kept_.end(), "the state after '" + name + "' was not kept");
  return found->second;
}

void EarlierStates::save(Snapshot& snapshot) const {
  for (const auto& [name, kept] : kept_) {
    snapshot.set("earlier/analysis/" + name, static_cast<double>(kept.analysis));
    snapshot.set_text("earlier/state/" + name, kept.state.encode());
  }
}

void EarlierStates::restore(const Snapshot& snapshot) {
  for (const std::string& name : wanted_) {
    if (!snapshot.has("earlier/analysis/" + name)) continue;
    keep(name, static_cast<std::size_t>(snapshot.integer("earlier/analysis/" + name)),
         Snapshot::decode(snapshot.text("earlier/state/" + name)));
  }
}

}  // namespace culm::simulation
