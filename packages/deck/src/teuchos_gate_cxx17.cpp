#include "teuchos_gate.hpp"

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_StandardParameterEntryValidators.hpp>

#include <cmath>
#include <exception>
#include <limits>
#include <type_traits>

namespace culm::deck {
namespace {

using Teuchos::Array;
using Teuchos::ParameterEntry;
using Teuchos::ParameterEntryValidator;
using Teuchos::ParameterList;
using Teuchos::RCP;
using Teuchos::rcp;

template <class T>
ParameterEntry make_entry(const T& content) {
  return ParameterEntry(content);
}

template <class Item>
ParameterEntry make_entry(const std::vector<Item>& items) {
  return ParameterEntry(Array<Item>(items));
}

ParameterEntry make_entry(const Value& value) {
  return std::visit([](const auto& content) { return make_entry(content); }, value);
}

/// A value of the right type for a required parameter; the schema has no other to offer.
Value zero(Kind kind) {
  switch (kind) {
    case Kind::number:
      return 0.0;
    case Kind::integer:
      return 0;
    case Kind::flag:
      return false;
    case Kind::text:
      return std::string();
    case Kind::numbers:
      return std::vector<double>();
    case Kind::integers:
      return std::vector<int>();
    case Kind::texts:
      return std::vector<std::string>();
  }
  return 0.0;
}

/// Teuchos' bounds are inclusive; an open end moves to the next number inside.
RCP<const Teuchos::EnhancedNumberValidator<double>> number_validator(const Field& field) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto validator = rcp(new Teuchos::EnhancedNumberValidator<double>);
  if (const auto& lower = field.lower()) {
    validator->setMin(lower->inclusive ? lower->value : std::nextafter(lower->value, infinity));
  }
  if (const auto& upper = field.upper()) {
    validator->setMax(upper->inclusive ? upper->value : std::nextafter(upper->value, -infinity));
  }
  return validator;
}

RCP<const Teuchos::EnhancedNumberValidator<int>> integer_validator(const Field& field) {
  const auto validator = rcp(new Teuchos::EnhancedNumberValidator<int>);
  if (const auto& lower = field.lower()) {
    const double least = std::ceil(lower->value);
    const bool excluded = !lower->inclusive && least == lower->value;
    validator->setMin(static_cast<int>(excluded ? least + 1.0 : least));
  }
  if (const auto& upper = field.upper()) {
    const double most = std::floor(upper->value);
    const bool excluded = !upper->inclusive && most == upper->value;
    validator->setMax(static_cast<int>(excluded ? most - 1.0 : most));
  }
  return validator;
}

RCP<const Teuchos::StringValidator> choice_validator(const Field& field) {
  return rcp(new Teuchos::StringValidator(Array<std::string>(field.choices())));
}

/// Null if the field has neither bounds nor choices.
RCP<const ParameterEntryValidator> make_validator(const Field& field) {
  if (!field.lower() && !field.upper() && field.choices().empty()) return Teuchos::null;
  switch (field.kind()) {
    case Kind::number:
      return number_validator(field);
    case Kind::integer:
      return integer_validator(field);
    case Kind::text:
      return choice_validator(field);
    case Kind::numbers:
      return rcp(new Teuchos::ArrayNumberValidator<double>(number_validator(field)));
    case Kind::integers:
      return rcp(new Teuchos::ArrayNumberValidator<int>(integer_validator(field)));
    case Kind::texts:
      return rcp(new Teuchos::ArrayStringValidator(choice_validator(field)));
    case Kind::flag:
      break;
  }
  return Teuchos::null;
}

const Schema& chosen_schema(const Schema::Slot& slot, const Options& options) {
  return *slot.find(slot.by_type() ? options.text("Type") : std::string());
}

/// The given values of a list, without defaults and without the lists in it.
ParameterList given_values(const Options& options) {
  ParameterList list(options.name());
  for (const Options::Parameter& parameter : options.parameters()) {
    if (parameter.given && parameter.value) {
      list.setEntry(parameter.name, make_entry(*parameter.value));
    }
  }
  return list;
}

/// What the schema allows there. A type that was chosen follows `options`.
ParameterList valid_values(const Options& options, const Schema& schema, bool by_type) {
  ParameterList list(options.name());
  if (by_type) list.setEntry("Type", make_entry(options.text("Type")));
  for (const Field& field : schema.fields()) {
    // Teuchos would fill in whatever is valid; a parameter that may be absent stays absent.
    if (!options.has(field.name())) continue;
    ParameterEntry entry = make_entry(field.default_value().value_or(zero(field.kind())));
    entry.setValidator(make_validator(field));
    entry.setDocString(field.doc());
    list.setEntry(field.name(), entry);
  }
  return list;
}

template <class T>
bool holds(const ParameterEntry& entry, const T& content) {
  return entry.isType<T>() && Teuchos::getValue<T>(entry) == content;
}

template <class Item>
bool holds(const ParameterEntry& entry, const std::vector<Item>& items) {
  return entry.isType<Array<Item>>() && Teuchos::getValue<Array<Item>>(entry).toVector() == items;
}

std::string first_difference(const Options& options, const ParameterList& list) {
  for (const Options::Parameter& parameter : options.parameters()) {
    const ParameterEntry* entry = list.getEntryPtr(parameter.name);
    const bool same =
        parameter.value
            ? entry && std::visit([&](const auto& content) { return holds(*entry, content); },
                                  *parameter.value)
            : entry == nullptr;
    if (!same) return "'" + parameter.name + "' of '" + options.name() + "' differs";
  }
  return {};
}

/// List by list, so that a large deck is not there as a whole once more.
std::string objection_to(const Options& options, const Schema& schema, bool by_type) {
  ParameterList list = given_values(options);
  list.validateParametersAndSetDefaults(valid_values(options, schema, by_type));
  std::string objection = first_difference(options, list);
  for (const auto* lists : {&options.lists(), &options.entries()}) {
    for (const Options& child : *lists) {
      if (!objection.empty()) return objection;
      const Schema::Slot& slot = *schema.find_slot(child.name());
      objection = objection_to(child, chosen_schema(slot, child), slot.by_type());
    }
  }
  return objection;
}

}  // namespace

std::string teuchos_objection(const Options& options, const Schema& schema) {
  try {
    return objection_to(options, schema, false);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace culm::deck
