/// States of earlier analyses that later ones start from.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/snapshot.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>

namespace culm::simulation {

/// Keeps the states at the ends of those analyses that others name in `Start From`.
class EarlierStates {
 public:
  /// What `Start From` may say instead of the name of an analysis.
  static constexpr const char* reference = "Reference";

  /// @param analyses  the list of the deck. Throws InputError where an analysis starts from one
  /// that
  ///                  does not come before it
  explicit EarlierStates(const Options& analyses);

  /// Whether an analysis starts from there.
  static bool wants_reference(const Options& analyses);

  /// A state, and the analysis at whose end it was.
  struct Kept {
    std::size_t analysis = 0;
    Snapshot state;
  };

  bool wants(const std::string& analysis) const { return wanted_.contains(analysis); }
  void keep(const std::string& name, std::size_t analysis, Snapshot state);
  const Kept& find(const std::string& name) const;

  /// Under "earlier/".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  std::set<std::string> wanted_;
  std::map<std::string, Kept> kept_;
};

}  // namespace culm::simulation
