#pragma once

// This header stays C++17: the sources that need Teuchos validators read it as such.

#include <culm/base/value.hpp>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm {

/// One end of a range of numbers.
struct Bound {
  double value = 0.0;
  bool inclusive = true;
};

/// Declaration of one parameter: name, kind, unit, bounds, default and one sentence. Required
/// unless made optional. Made by the functions below and refined by chaining:
///
///     number("Density", "kg/m^3", "Mass per volume.").non_negative().optional(0.0)
///
/// Bounds of an array hold for each item.
class Field {
 public:
  Field(Kind kind, std::string name, std::string unit, std::string doc);

  Field& positive() { return greater_than(0.0); }
  Field& non_negative() { return at_least(0.0); }
  Field& at_least(double lower);
  Field& at_most(double upper);
  Field& between(double lower, double upper) { return at_least(lower).at_most(upper); }
  Field& greater_than(double lower);
  Field& less_than(double upper);

  /// Arrays: the exact number of items.
  Field& size(int count);
  /// Arrays: the number of items is a multiple of `count`.
  Field& size_multiple_of(int count);
  /// Arrays: the least number of items.
  Field& min_size(int count);

  /// Texts: the allowed names.
  Field& one_of(std::vector<std::string> choices);
  /// Texts: a formula in this variable. The deck puts in its own variables as numbers.
  Field& formula_in(std::string variable);

  /// May be absent, and has no value then.
  Field& optional();
  /// May be absent, and has this value then. The default must itself obey the rules declared before
  /// it, or InternalError.
  Field& optional(double value);
  Field& optional(int value);
  Field& optional(bool value);
  Field& optional(const char* value);
  Field& optional(std::string value);
  Field& optional(std::vector<double> value);
  Field& optional(std::vector<int> value);
  Field& optional(std::vector<std::string> value);
  Field& optional(std::initializer_list<double> value);
  Field& optional(std::initializer_list<std::string> value);

  Kind kind() const { return kind_; }
  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }
  const std::string& doc() const { return doc_; }
  bool required() const { return required_; }
  const std::optional<Value>& default_value() const { return default_; }
  const std::optional<Bound>& lower() const { return lower_; }
  const std::optional<Bound>& upper() const { return upper_; }
  const std::vector<std::string>& choices() const { return choices_; }
  /// The variable of a formula; empty for any other text.
  const std::string& formula_variable() const { return formula_variable_; }

  /// The rule of the range in words with unit, such as "> 0 kg"; empty if there is none.
  std::string range_text() const;
  /// The rule of the size in words, such as "3 items"; empty if there is none.
  std::string size_text() const;

  /// What is wrong with a value of this kind, one message per broken rule, such as
  /// "must be > 0 kg, got -15"; empty if nothing is.
  std::vector<std::string> mistakes(const Value& value) const;

 private:
  Field& set_default(Value value);
  bool in_range(double value) const;
  std::string wrong_size(std::size_t count) const;
  std::string wrong_item(double value) const;
  std::string wrong_item(const std::string& value) const;
  template <class Item>
  void find_wrong_items(const std::vector<Item>& items, std::vector<std::string>& messages) const;

  Kind kind_;
  std::string name_;
  std::string unit_;
  std::string doc_;
  bool required_ = true;
  std::optional<Value> default_;
  std::optional<Bound> lower_;
  std::optional<Bound> upper_;
  std::optional<int> size_;
  std::optional<int> multiple_;
  std::optional<int> min_size_;
  std::vector<std::string> choices_;
  std::string formula_variable_;
};

/// A finite number; `unit` is SI, "1" or empty for none.
Field number(std::string name, std::string unit, std::string doc);
Field integer(std::string name, std::string doc);
/// true or false
Field flag(std::string name, std::string doc);
Field text(std::string name, std::string doc);
/// A text out of a fixed set.
Field choice(std::string name, std::vector<std::string> choices, std::string doc);
Field numbers(std::string name, std::string unit, std::string doc);
Field integers(std::string name, std::string doc);
Field texts(std::string name, std::string doc);

}  // namespace culm
