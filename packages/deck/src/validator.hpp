#pragma once

#include <culm/base/issue.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include "raw_list.hpp"
#include "scope.hpp"

#include <string>

namespace culm::deck {

/// Walks a raw deck along a schema, makes options and collects every mistake on the way. The result
/// is complete only if there was none.
class Validator {
 public:
  explicit Validator(InputIssues& issues) : issues_(issues) {}

  Options root(const RawList& raw, const Schema& schema);

 private:
  /// A list with what surrounds it.
  struct Place {
    const RawList& raw;
    std::string path;  ///< empty for the root
    const Scope& outer;
  };

  Options list(const Place& place, const Schema& schema, const RawParameter* type);
  Options list_of_slot(const Place& place, const Schema::Slot& slot);
  void define_variables(const Place& place, Scope& scope);
  void read_field(const Place& place, const Schema& schema, const Field& field, const Scope& scope,
                  Options& options);
  void read_lists(const Place& place, const Schema& schema, const Scope& scope, Options& options);
  void absent_list(const Place& place, const Schema& schema, const Schema::Slot& slot,
                   const Scope& scope, Options& options);
  void report_missing(const Place& place, bool is_misspelt, const std::string& message);
  void report_unknown(const Place& place, const Schema& schema, bool has_type);
  void report(const Place& place, const std::string& message);
  void report(const RawParameter& parameter, const std::string& list_path,
              const std::string& message);

  InputIssues& issues_;
  std::size_t silent_mistakes_ = 0;  ///< missing, but for a reason that has its own issue
};

}  // namespace culm::deck
