#pragma once

// This header stays C++17: the sources that need Teuchos validators read it as such.

#include <culm/base/field.hpp>
#include <culm/base/issue.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace culm {

class Options;
class Schema;

/// A set of schemas of which the parameter `Type` of a list chooses one; usually
/// Registry::variants.
using Variants = std::map<std::string, Schema>;

/// Whether a list must be written in the deck. A `defaulted` list is built from the defaults of its
/// schema when it is not; an `optional` one is absent then.
enum class Presence { required, optional, defaulted };

/// What a list reads from the deck, declared once; validation, error texts and the input reference
/// derive from it. A value: copies are independent.
///
///     Schema("Tube", "Circular hollow section.")
///         .add(number("Outer Radius", "m", "Radius of the outer circle.").positive())
///         .add(number("Wall", "m", "Thickness of the wall.").positive())
///         .check([](const Options& tube, InputIssues& issues) { … });
class Schema {
 public:
  /// Rule across parameters; runs after the list and all below it were found valid.
  using Check = std::function<void(const Options&, InputIssues&)>;

  /// A sub-list: of one schema, or of the schema that its parameter `Type` chooses.
  struct Slot {
    std::string name;  ///< empty for entries, which the user names
    Presence presence = Presence::optional;
    std::shared_ptr<const Schema> schema;      ///< or
    std::shared_ptr<const Variants> variants;  ///< exactly one of the two
    std::string default_type;                  ///< the `Type` when none is written; may be empty

    bool by_type() const { return variants != nullptr; }
    /// The schema for a type; null if there is no such type. The type of a plain slot is ignored.
    const Schema* find(const std::string& type) const;
    /// Names of the types; empty for a plain slot.
    std::vector<std::string> types() const;
  };

  explicit Schema(std::string name, std::string doc = {});

  Schema& add(Field field);
  /// All fields and checks of another schema; for what several types share.
  Schema& add_all(const Schema& other);
  Schema& list(std::string name, Schema schema, Presence presence = Presence::required);
  Schema& list_by_type(std::string name, Variants variants, Presence presence = Presence::required,
                       std::string default_type = {});
  /// Sub-lists of one schema, named by the user.
  Schema& entries(Schema schema);
  /// Sub-lists named by the user, of the schema that their `Type` chooses.
  Schema& entries_by_type(Variants variants);
  Schema& check(Check check);

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  const std::vector<Field>& fields() const { return fields_; }
  const std::vector<Slot>& lists() const { return lists_; }
  const std::optional<Slot>& entries() const { return entries_; }
  const std::vector<Check>& checks() const { return checks_; }

  /// Null if there is no such field.
  const Field* find_field(const std::string& name) const;
  /// The slot of a fixed-name list, or else the slot of entries; null if neither fits.
  const Slot* find_slot(const std::string& name) const;
  std::vector<std::string> field_names() const;
  std::vector<std::string> list_names() const;

 private:
  void check_name_is_free(const std::string& name) const;

  std::string name_;
  std::string doc_;
  std::vector<Field> fields_;
  std::vector<Slot> lists_;
  std::optional<Slot> entries_;
  std::vector<Check> checks_;
};

}  // namespace culm
