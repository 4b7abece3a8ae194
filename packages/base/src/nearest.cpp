#include <culm/base/nearest.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <utility>

namespace culm {
namespace {

/// Edits that turn a into b: insert, delete, replace, swap neighbours (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    before_last = std::exchange(last, std::move(row));
  }
  return last.back();
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  // Names come from the deck and may be of any length; nothing long is a misspelt name.
  constexpr std::size_t longest = 100;
  if (name.empty() || name.size() > longest) return {};
  const std::string wanted = to_lower(name);
  std::string nearest;
  std::size_t least = (wanted.size() + 2) / 3 + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest) continue;
    const std::size_t distance = edit_distance(wanted, to_lower(candidate));
    // A name of which every letter had to change is another name.
    if (distance < least && distance < std::max(wanted.size(), candidate.size())) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  if (!nearest.empty()) return " – did you mean '" + nearest + "'?";
  if (candidates.empty()) return {};
  return " (allowed: " + join(candidates, ", ") + ")";
}

}  // namespace culm
