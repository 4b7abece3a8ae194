#include <culm/base/findings.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace culm {

void Findings::warn(const std::string& kind, const std::string& text, double time) {
  add({Finding::Grade::warning, kind, text, analysis_, time});
}

void Findings::broken(const std::string& kind, const std::string& text, double time) {
  add({Finding::Grade::broken, kind, text, analysis_, time});
}

void Findings::add(Finding finding) {
  const bool is_known = std::any_of(list_.begin(), list_.end(), [&](const Finding& other) {
    return other.kind == finding.kind && other.text == finding.text &&
           other.analysis == finding.analysis;
  });
  if (is_known) return;
  log_.warning(finding.text);
  list_.push_back(std::move(finding));
}

std::string Findings::verdict(bool strict) const {
  std::string names;
  int count = 0;
  for (const Finding& finding : list_) {
    if (finding.grade == Finding::Grade::warning && !strict) continue;
    names += count++ == 0 ? "" : ", ";
    names += finding.kind;
    if (!finding.analysis.empty()) names += fmt::format(" ({})", finding.analysis);
  }
  if (count == 0) return {};
  return fmt::format("The run came to its end, but {} of its promises {}: {}; see the {} above.",
                     count, count == 1 ? "does not hold" : "do not hold", names,
                     count == 1 ? "warning" : "warnings");
}

void Findings::save(Snapshot& snapshot) const {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const std::string name = fmt::format("findings/{} ", i);
    snapshot.set_text(name + "kind", list_[i].kind);
    snapshot.set_text(name + "text", list_[i].text);
    snapshot.set_text(name + "analysis", list_[i].analysis);
    numbers.push_back(list_[i].grade == Finding::Grade::broken ? 1.0 : 0.0);
    numbers.push_back(list_[i].time);
  }
  snapshot.set("findings/numbers", std::move(numbers));
}

void Findings::restore(const Snapshot& snapshot) {
  const std::span<const double> numbers = snapshot.numbers("findings/numbers");
  for (std::size_t i = 0; 2 * i + 1 < numbers.size(); ++i) {
    const std::string name = fmt::format("findings/{} ", i);
    add({numbers[2 * i] != 0.0 ? Finding::Grade::broken : Finding::Grade::warning,
         snapshot.text(name + "kind"), snapshot.text(name + "text"),
         snapshot.text(name + "analysis"), numbers[2 * i + 1]});
  }
}

}  // namespace culm
