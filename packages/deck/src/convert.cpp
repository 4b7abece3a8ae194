#include "convert.hpp"

#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/units.hpp>

#include "array_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace culm::deck {
namespace {

constexpr const char* no_value = "has no attribute 'value'";

constexpr std::array kinds = {Kind::number,  Kind::integer,  Kind::flag, Kind::text,
                              Kind::numbers, Kind::integers, Kind::texts};

/// Turns text into numbers of one parameter.
class Converter {
 public:
  /// @param written  the unit in the deck, for messages; may be absent
  Converter(const Scope& scope, const Unit& unit, const std::optional<std::string>& written)
      : scope_(scope), unit_(unit), written_(written) {}

  std::optional<double> number(const std::string& text) {
    const Evaluation evaluation = scope_.evaluate(text);
    if (!evaluation.mistake.empty()) return fail(evaluation.mistake);
    const double value = unit_.to_si(evaluation.value);
    // what is too small keeps few digits, or none
    if (std::isnormal(value) || evaluation.value == 0.0) return value;
    return fail(
        fmt::format("must be from {:.3g} to {:.3g} in size when it is in SI units, got {}{}",
                    std::numeric_limits<double>::min(), std::numeric_limits<double>::max(),
                    quoted(trim(text)), written_ ? " in " + *written_ : std::string()));
  }

  std::optional<int> integer(const std::string& text) {
    const Evaluation evaluation = scope_.evaluate(text);
    if (!evaluation.mistake.empty()) {
      const std::string_view rule = "must be a number";
      const bool plain = evaluation.mistake.starts_with(rule);
      fail(plain ? "must be an integer" + evaluation.mistake.substr(rule.size())
                 : evaluation.mistake);
      return std::nullopt;
    }
    if (evaluation.value != std::floor(evaluation.value)) {
      const bool literal = literal_number(trim(text)).has_value();
      fail("must be an integer, got " + quoted(trim(text)) +
           (literal ? "" : ", which is " + format_number(evaluation.value)));
      return std::nullopt;
    }
    if (std::abs(evaluation.value) > std::numeric_limits<int>::max()) {
      fail("must be an integer of at most " + std::to_string(std::numeric_limits<int>::max()) +
           " in size, got " + quoted(trim(text)));
      return std::nullopt;
    }
    return static_cast<int>(evaluation.value);
  }

  std::optional<bool> flag(const std::string& text) {
    const std::string_view word = trim(text);
    if (word == "true" || word == "false") return word == "true";
    fail("must be true or false, got " + quoted(text));
    return std::nullopt;
  }

  /// All items by one of the functions above.
  template <class Item>
  std::optional<std::vector<Item>> array(
      const std::string& text, std::optional<Item> (Converter::*item)(const std::string&)) {
    const auto texts = split_array(text);
    if (!texts) {
      fail("must be an array such as {1, 2, 3}, got " + quoted(text));
      return std::nullopt;
    }
    std::vector<Item> items;
    items.reserve(texts->size());
    for (const std::string& one : *texts) {
      ++item_;
      if (const std::optional<Item> value = (this->*item)(one)) items.push_back(*value);
    }
    return mistakes_.empty() ? std::optional(std::move(items)) : std::nullopt;
  }

  std::optional<std::vector<std::string>> texts(const std::string& text) {
    auto items = split_array(text);
    if (!items) fail("must be an array such as {a, b, c}, got " + quoted(text));
    return items;
  }

  std::vector<std::string> take_mistakes() {
    if (count_ > shown) {
      mistakes_.push_back(std::to_string(count_ - shown) + " more items are wrong");
    }
    return std::move(mistakes_);
  }

 private:
  static constexpr std::size_t shown = 5;

  std::optional<double> fail(const std::string& mistake) {
    if (++count_ <= shown) {
      mistakes_.push_back(item_ > 0 ? "item " + std::to_string(item_) + ": " + mistake : mistake);
    }
    return std::nullopt;
  }

  const Scope& scope_;
  const Unit& unit_;
  const std::optional<std::string>& written_;
  int item_ = 0;  ///< from 1; 0 for a single value
  std::size_t count_ = 0;
  std::vector<std::string> mistakes_;
};

template <class Content>
std::optional<Value> to_value(std::optional<Content> content) {
  return content ? std::optional<Value>(std::move(*content)) : std::nullopt;
}

std::optional<Value> parse(Converter& converter, Kind kind, const std::string& text) {
  switch (kind) {
    case Kind::number:
      return to_value(converter.number(text));
    case Kind::integer:
      return to_value(converter.integer(text));
    case Kind::flag:
      return to_value(converter.flag(text));
    case Kind::text:
      return text;
    case Kind::numbers:
      return to_value(converter.array<double>(text, &Converter::number));
    case Kind::integers:
      return to_value(converter.array<int>(text, &Converter::integer));
    case Kind::texts:
      return to_value(converter.texts(text));
  }
  return std::nullopt;
}

/// Complains about a `type=` that is not the field's; the schema knows the type anyway.
std::string wrong_type(const RawParameter& raw, Kind kind) {
  if (!raw.type || *raw.type == type_name(kind)) return {};
  std::vector<std::string> known;
  for (const Kind one : kinds) known.push_back(type_name(one));
  if (std::ranges::find(known, *raw.type) == known.end()) {
    return "unknown type=\"" + *raw.type + "\"" + did_you_mean(*raw.type, known);
  }
  return "must have type=\"" + type_name(kind) + "\", got type=\"" + *raw.type + "\"";
}

std::string unknown_unit(const std::string& unit) {
  const std::string nearest = nearest_name(unit, unit_names());
  return "unknown unit '" + unit + "'" +
         (nearest.empty() ? "" : " – did you mean '" + nearest + "'?");
}

/// The factor of the unit that is written to the one that is declared; mistakes go to `mistakes`.
Unit find_factor(const RawParameter& raw, const Field& field, std::vector<std::string>& mistakes) {
  if (!raw.unit) return {};
  const bool measured = field.kind() == Kind::number || field.kind() == Kind::numbers;
  const std::optional<Unit> written = find_unit(*raw.unit);
  const std::optional<Unit> declared = find_unit(field.unit().empty() ? "1" : field.unit());
  if (!measured) {
    mistakes.push_back("takes no unit, got '" + *raw.unit + "'");
  } else if (!written) {
    mistakes.push_back(unknown_unit(*raw.unit));
  } else {
    internal_check(declared.has_value(),
                   "the unit '" + field.unit() + "' of '" + field.name() + "' is not understood");
    if (!written->same_dimension(*declared)) {
      mistakes.push_back(field.unit().empty() ? "takes no unit, got '" + *raw.unit + "'"
                                              : "must be in units of '" + field.unit() +
                                                    "', got '" + *raw.unit + "'");
      return {};
    }
    return {written->powers, written->numerator * declared->denominator,
            written->denominator * declared->numerator};
  }
  return {};
}

/// What was written, if a message about the value alone would not show it.
std::string origin(const RawParameter& raw, const Value& value) {
  const bool scalar = kind_of(value) == Kind::number || kind_of(value) == Kind::integer;
  if (raw.unit) return " (" + quoted(*raw.value) + " in " + *raw.unit + ")";
  return scalar && !literal_number(trim(*raw.value)) ? " (" + quoted(*raw.value) + ")" : "";
}

}  // namespace

std::string type_name(Kind kind) {
  static constexpr std::array names = {"double",        "int",        "bool",         "string",
                                       "Array(double)", "Array(int)", "Array(string)"};
  return names.at(static_cast<std::size_t>(kind));
}

Conversion convert(const RawParameter& raw, const Field& field, const Scope& scope) {
  Conversion result;
  if (!raw.value) {
    if (!raw.is_reported) result.mistakes.emplace_back(no_value);
    return result;
  }
  if (std::string mistake = wrong_type(raw, field.kind()); !mistake.empty()) {
    result.mistakes.push_back(std::move(mistake));
    return result;
  }
  const Unit factor = find_factor(raw, field, result.mistakes);
  if (!result.mistakes.empty()) return result;
  Converter converter(scope, factor, raw.unit);
  result.value = parse(converter, field.kind(), *raw.value);
  if (!field.formula_variable().empty()) {
    result.value = scope.substitute(*raw.value, field.formula_variable());
  }
  result.mistakes = converter.take_mistakes();
  if (!result.value || !result.mistakes.empty()) return result;
  for (const std::string& mistake : field.mistakes(*result.value)) {
    result.mistakes.push_back(mistake + origin(raw, *result.value));
  }
  return result;
}

Conversion convert_variable(const RawParameter& raw, const Scope& scope) {
  Conversion result;
  if (!raw.value) {
    if (!raw.is_reported) result.mistakes.emplace_back(no_value);
    return result;
  }
  const std::optional<Unit> unit = raw.unit ? find_unit(*raw.unit) : Unit{};
  if (!unit) {
    result.mistakes.push_back(unknown_unit(*raw.unit));
    return result;
  }
  Converter converter(scope, *unit, raw.unit);
  result.value = to_value(converter.number(*raw.value));
  result.mistakes = converter.take_mistakes();
  return result;
}

}  // namespace culm::deck
