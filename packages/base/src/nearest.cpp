#include <culm/base/nearest.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <array>

namespace culm {
namespace {

// Names come from the deck and may be of any length; nothing long is a misspelt name.
constexpr std::size_t longest = 100;
// Of more candidates a user sees the first ones.
constexpr std::size_t listed = 60;

/// Edits that turn a into b: insert, delete, replace, swap neighbours (optimal string alignment).
/// @pre both have at most `longest` characters
std::size_t edit_distance(const std::string& a, const std::string& b) {
  using Row = std::array<std::size_t, longest + 1>;
  std::array<Row, 3> rows;
  for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    Row& row = rows[i % 3];
    const Row& last = rows[(i + 2) % 3];
    const Row& before_last = rows[(i + 1) % 3];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return rows[a.size() % 3][b.size()];
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.empty() || name.size() > longest) return {};
  const std::string wanted = to_lower(name);
  std::string nearest;
  std::size_t least = (wanted.size() + 2) / 3 + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest) continue;
    // no edits make up for the lengths
    const auto [shorter, longer] = std::minmax({candidate.size(), wanted.size()});
    if (longer - shorter >= least) continue;
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
  if (candidates.size() <= listed) return " (allowed: " + join(candidates, ", ") + ")";
  const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(listed);
  return " (allowed: " + join({candidates.begin(), end}, ", ") + " and " +
         std::to_string(candidates.size() - listed) + " more)";
}

}  // namespace culm
