#pragma once

// This header stays C++17: the sources that need Teuchos validators read it as such.

#include <culm/base/issue.hpp>
#include <culm/base/value.hpp>

#include <optional>
#include <string>
#include <vector>

namespace culm {

/// One validated list of the deck with its defaults filled in: a plain tree of values and lists.
/// Readers ask by name. A name that the schema does not declare, a value that is absent and a wrong
/// kind are bugs of the reader, hence InternalError. Units are SI.
class Options {
 public:
  /// A value with its origin.
  struct Parameter {
    std::string name;
    std::optional<Value> value;  ///< empty: optional without default, and not in the deck
    bool given = false;          ///< written in the deck, hence no default
    Where where;                 ///< of the parameter if given, else of its list
  };

  explicit Options(std::string name = {}, Where where = {});

  /// Name of the list: the user's for entries, the schema's for fixed lists.
  const std::string& name() const { return name_; }
  /// Place of the list in the deck.
  const Where& where() const { return where_; }
  /// Place of a parameter; that of the list, if the parameter is not written in the deck.
  const Where& where(const std::string& parameter) const;

  double number(const std::string& name) const;
  int integer(const std::string& name) const;
  bool flag(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name) const;
  const std::vector<int>& integers(const std::string& name) const;
  const std::vector<std::string>& texts(const std::string& name) const;

  /// There is a value, written in the deck or by default.
  bool has(const std::string& name) const;
  /// The value is written in the deck.
  bool given(const std::string& name) const;

  /// A sub-list: one of fixed name, or the user's entry of this name.
  const Options& list(const std::string& name) const;
  /// Whether the sub-list is there; an absent one must at least be declared, unless the schema has
  /// entries.
  bool has_list(const std::string& name) const;
  /// The sub-lists named by the user, in the order of the deck.
  const std::vector<Options>& entries() const { return entries_; }

  /// All declared parameters, with or without value, in the order of the schema.
  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// The sub-lists of fixed names that are there.
  const std::vector<Options>& lists() const { return lists_; }

  // For whoever fills the list: the deck, and tests.

  /// Sets or replaces a value, declaring the name.
  Options& set(const std::string& name, Value value);
  /// Sets or replaces a value with its origin.
  Options& set(const std::string& name, Value value, bool given, Where where);
  /// Declares a parameter that has no value.
  Options& declare(const std::string& name);
  /// Declares a sub-list that is absent.
  Options& declare_list(const std::string& name);
  Options& add_list(Options list);
  Options& add_entry(Options entry);
  /// Says that the schema has entries, even if the deck has none.
  Options& declare_entries();

 private:
  const Parameter* find_parameter(const std::string& name) const;
  const Options* find_list(const std::string& name) const;
  const Parameter& parameter(const std::string& name) const;
  template <class T>
  const T& value(const std::string& name) const;

  std::string name_;
  Where where_;
  std::vector<Parameter> parameters_;
  std::vector<Options> lists_;
  std::vector<std::string> absent_lists_;
  std::vector<Options> entries_;
  bool has_entries_ = false;
};

}  // namespace culm
