/// The list "Imperfections" of the deck.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/model/imperfection.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace culm::simulation {

Schema imperfections_schema();

/// What bends the stress-free geometry, and in which analyses: shapes of another run in all, a
/// shape that an analysis of this run finds in those after it.
class Imperfections {
 public:
  /// Throws InputError where an entry names no analysis of the deck that gives shapes.
  /// @param gives_shapes  types of analyses that do
  Imperfections(const Options& deck, const std::set<std::string>& gives_shapes);

  /// Entries whose shape is not there yet when an analysis begins.
  std::set<std::string> unknown_in(std::size_t analysis) const;
  /// Entries with shapes of this run that act while those of `inactive` do not.
  std::set<std::string> acting(const std::set<std::string>& inactive) const;

  /// The shapes of an analysis that ended, as far as entries want them. Throws InputError where
  /// there are too few.
  void keep(const std::string& analysis, const model::Model& model,
            const analysis::AnalysisReport& report);

  /// Motions of all nodes by the entries that act; those that are not known yet are left out.
  /// Throws FileError where another run cannot be read.
  model::Imperfection sum(const std::set<std::string>& inactive) const;

  /// Under "imperfection/".
  void save(Snapshot& snapshot) const;
  /// @param model  with the structures of the run
  void restore(const Snapshot& snapshot, const model::Model& model);

 private:
  using Shape = std::map<std::string, std::vector<Vec6>>;  ///< by structure, per node

  Options list_;
  std::map<std::string, std::size_t> sources_;  ///< analyses of this run, by entry
  std::map<std::string, Shape> found_;          ///< by entry
};

}  // namespace culm::simulation
