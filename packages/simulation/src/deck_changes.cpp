#include <culm/base/value.hpp>
#include <culm/simulation/deck_changes.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace culm::simulation {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string shown(const std::optional<Value>& value) {
  return value ? to_string(*value) : std::string("absent");
}

const Options::Parameter* find(const Options& options, const std::string& name) {
  const auto& all = options.parameters();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const auto& parameter) { return parameter.name == name; });
  return found == all.end() ? nullptr : &*found;
}

void compare_parameter(const Options& before, const Options& now, const std::string& name,
                       InputIssues& issues) {
  const Options::Parameter* old = find(before, name);
  const Options::Parameter* present = find(now, name);
  const auto value = [](const auto* parameter) {
    return parameter == nullptr ? std::optional<Value>() : parameter->value;
  };
  if (value(old) == value(present)) return;
  issues.add(present != nullptr && present->given ? present->where : now.where(),
             "'" + name + "' was " + shown(value(old)) + " in the run and is " +
                 shown(value(present)) + " now");
}

Names names_of(const std::vector<Options>& lists) {
  Names names;
  for (const Options& list : lists) names.push_back(list.name());
  return names;
}

// Everything in a list but what has one of the free names.
void compare(const Options& before, const Options& now, const Names& free, InputIssues& issues);

void compare_lists(const Options& before, const std::vector<Options>& old_lists, const Options& now,
                   const std::vector<Options>& lists, const Names& free, InputIssues& issues) {
  const Names old_names = names_of(old_lists);
  const Names names = names_of(lists);
  for (const Options& list : lists) {
    if (contains(free, list.name())) continue;
    if (contains(old_names, list.name())) {
      compare(before.list(list.name()), list, {}, issues);
    } else {
      issues.add(list.where(), "was not in the run");
    }
  }
  Names missing;
  for (const std::string& name : old_names) {
    if (contains(free, name) || contains(names, name)) continue;
    missing.push_back(name);
    issues.add(now.where(), "'" + name + "' was in the run and is missing now");
  }
  if (missing.empty() && names.size() == old_names.size() && names != old_names &&
      std::is_permutation(names.begin(), names.end(), old_names.begin())) {
    issues.add(now.where(), "had another order in the run");
  }
}

void compare(const Options& before, const Options& now, const Names& free, InputIssues& issues) {
  const Options::Parameter* type = find(now, "Type");
  if (type != nullptr && !contains(free, "Type")) {
    const std::size_t found = issues.size();
    compare_parameter(before, now, "Type", issues);
    if (issues.size() > found) return;  // other types have other parameters
  }
  for (const Options::Parameter& parameter : now.parameters()) {
    if (parameter.name == "Type" || contains(free, parameter.name)) continue;
    compare_parameter(before, now, parameter.name, issues);
  }
  compare_lists(before, before.lists(), now, now.lists(), free, issues);
  compare_lists(before, before.entries(), now, now.entries(), free, issues);
}

void compare_analyses(const Options& before, const Options& now, std::size_t analysis, double time,
                      const std::set<std::string>& returns, InputIssues& issues) {
  for (std::size_t i = 0; i <= analysis; ++i) {
    const Options& old = before.entries()[i];
    if (i >= now.entries().size() || now.entries()[i].name() != old.name()) {
      issues.add(now.where(), "analysis " + std::to_string(i + 1) + " was '" + old.name() +
                                  "' in the run and is " +
                                  (i < now.entries().size() ? "'" + now.entries()[i].name() + "'"
                                                            : std::string("missing")) +
                                  " now");
      return;
    }
    const Options& present = now.entries()[i];
    if (i < analysis) {
      compare(old, present, {"Newton"}, issues);
      continue;
    }
    for (const char* name :
         {"Type", "Scheme", "Spectral Radius", "Start Time", "Start From", "Inactive"}) {
      compare_parameter(old, present, name, issues);
    }
    for (const char* name : {"End Time", "Final Level"}) {
      if (find(present, name) == nullptr || returns.contains(present.text("Type"))) continue;
      if (present.number(name) >= time) continue;
      issues.add(present.where(name), "the run has reached " + to_string(Value(time)) + ", got " +
                                          to_string(Value(present.number(name))));
    }
  }
}

}  // namespace

InputIssues find_forbidden_changes(const Options& before, const Options& now, std::size_t analysis,
                                   double time, const std::set<std::string>& returns) {
  InputIssues issues;
  compare(before, now, {"Title", "Output", "Analyses"}, issues);
  for (const char* list : {"History", "Shell"}) {
    compare(before.list("Output").list(list), now.list("Output").list(list), {}, issues);
  }
  compare_analyses(before.list("Analyses"), now.list("Analyses"), analysis, time, returns, issues);
  return issues;
}

}  // namespace culm::simulation
